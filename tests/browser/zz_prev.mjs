import { chromium } from "playwright-core";
import { createServer } from "node:http"; import { readFile } from "node:fs/promises";
const T={html:"text/html",css:"text/css",js:"text/javascript"};
const s=createServer(async(q,r)=>{const u=new URL(q.url,"http://x").pathname.slice(1)||"index.html";try{const b=await readFile("/tmp/lprev/"+u);r.writeHead(200,{"content-type":T[u.split(".").pop()]||"text/plain"});r.end(b)}catch{r.writeHead(404);r.end()}}).listen(0);
const o=`http://localhost:${s.address().port}/`;
const b=await chromium.launch({executablePath:"/usr/bin/chromium-headless-shell",args:["--no-sandbox"]});
for (const [w,h,scheme,name] of [[1280,900,"light","a"],[390,844,"dark","b"],[640,480,"light","c"]]) {
  const c=await b.newContext({viewport:{width:w,height:h},colorScheme:scheme}); const p=await c.newPage();
  p.on("pageerror",e=>console.log("ERR",e.message)); p.on("console",m=>m.type()==="error"&&console.log(m.text()));
  await p.goto(o); await p.waitForTimeout(500);
  if (name==="b") { await p.locator("#listing-one-ray [data-tab=rust][role=tab]").click(); }
  console.log(await p.evaluate(()=>[document.documentElement.scrollWidth, [...document.querySelectorAll(".listing pre")].filter(x=>x.scrollWidth>x.clientWidth+1).length, document.querySelector(".listing").clientWidth]));
  await p.screenshot({path:`/tmp/lprev/${name}.png`,fullPage:true});
  if (name==="a") { await p.emulateMedia({media:"print"}); await p.screenshot({path:`/tmp/lprev/print.png`,fullPage:true}); }
  await c.close();
}
await b.close(); s.close();
