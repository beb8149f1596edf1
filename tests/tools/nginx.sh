#!/bin/sh
# Serves target/book through nginx with the configuration of docs/hosting.md: nginx.sh PORT COMMAND…
# The command finds the address of the book in EPIPOLE_LIBRARY.
set -eu
port=$1
shift
root=$(cd "$(dirname "$0")/../.." && pwd)
modules=/usr/lib/nginx/modules
command -v nginx >/dev/null 2>&1 && [ -e $modules/ngx_http_brotli_static_module.so ] ||
    "$root/tests/tools/apt.sh" "serving the book" nginx-light libnginx-mod-http-brotli-static
folder=$(mktemp -d)
trap 'kill "$server" 2>/dev/null || true; rm -rf "$folder"' EXIT
{
    cat <<CONF
load_module $modules/ngx_http_brotli_static_module.so;
daemon off;
pid $folder/pid;
error_log $folder/error.log warn;
events {}
http {
    include /etc/nginx/mime.types;
    default_type application/octet-stream;
    access_log off;
    client_body_temp_path $folder/body;
    proxy_temp_path $folder/proxy;
    fastcgi_temp_path $folder/fastcgi;
    uwsgi_temp_path $folder/uwsgi;
    scgi_temp_path $folder/scgi;
CONF
    awk '/^```nginx$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$root/docs/hosting.md" |
        sed "s|listen 80;|listen 127.0.0.1:$port;|; s|/srv/epipole/|$root/target/book/|"
    echo "}"
} > "$folder/nginx.conf"
# As root, its workers would be of a user who may not read the folder of the book.
[ "$(id -u)" != 0 ] || sed -i '1i user root;' "$folder/nginx.conf"
PATH=$PATH:/usr/sbin nginx -q -t -p "$folder" -c nginx.conf
PATH=$PATH:/usr/sbin nginx -p "$folder" -c nginx.conf &
server=$!
until curl --silent --fail --output /dev/null "http://127.0.0.1:$port/book/index.html"; do
    kill -0 "$server"
    sleep 0.1
done
EPIPOLE_LIBRARY=http://127.0.0.1:$port/book "$@"
if [ -s "$folder/error.log" ]; then
    # Missing files that tests ask for on purpose are no errors.
    ! grep -v "No such file or directory" "$folder/error.log"
fi
