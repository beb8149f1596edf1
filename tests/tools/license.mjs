// SPDX license expressions.

/**
 * The license to use from an expression: the most preferred allowed alternative of `OR`, all parts
 * of `AND`; undefined if it is not allowed. `allow` is in order of preference.
 */
export function chosen(expression, allow) {
  const tokens = expression.replaceAll("/", " OR ").match(/\(|\)|[^\s()]+/g) ?? [];
  let at = 0;
  const either = () => {
    const found = [both()];
    while (tokens[at] === "OR") {
      at += 1;
      found.push(both());
    }
    const good = found.filter(Boolean);
    return good.sort((a, b) => rank(a) - rank(b))[0];
  };
  const rank = (license) => allow.findIndex((name) => license === name || license.startsWith(`${name} AND`)) >>> 0;
  const both = () => {
    const found = [one()];
    while (tokens[at] === "AND") {
      at += 1;
      found.push(one());
    }
    return found.every(Boolean) ? found.join(" AND ") : undefined;
  };
  const one = () => {
    const token = tokens[at++];
    if (token === "(") {
      const inner = either();
      at += 1;
      return inner;
    }
    if (token === undefined) return undefined;
    const name = tokens[at] === "WITH" ? `${token} WITH ${tokens[(at += 2) - 1]}` : token;
    return allow.includes(name) ? name : undefined;
  };
  const taken = either();
  return at === tokens.length ? taken : undefined;
}
