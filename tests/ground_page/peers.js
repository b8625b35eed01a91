/// The npm packages that scripts/setup --peers fetched; a test without them, or without the browser, is skipped with a line (77 for ctest).

import {existsSync} from "node:fs";
import {createRequire} from "node:module";
import {fileURLToPath} from "node:url";

export const ROOT = fileURLToPath(new URL("../..", import.meta.url));
export const CHROMIUM = process.env.CHROMIUM ?? "/usr/bin/chromium";

export function peers() {
  const require = createRequire(`${ROOT}build/npm/ground_page/package.json`);
  const missing = [[`${ROOT}build/npm/ground_page/node_modules/playwright-core`, "npm packages"], [`${ROOT}flight/ground/page/vendor/LICENSE`, "three"], [CHROMIUM, "chromium"]]
    .filter(([path]) => !existsSync(path)).map(([, name]) => name);
  if (missing.length) {
    console.log(`skipped: ${missing.join(", ")} missing; scripts/setup --peers installs them`);
    process.exit(77);
  }
  return {...require("@foxglove/ws-protocol"), ...require("ws"), ...require("playwright-core")};
}
