/// Debian's chromium, headless, WebGL by software; a page that notes errors and every request.

import {CHROMIUM, peers} from "./peers.js";

const ARGUMENTS = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
  "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-dev-shm-usage"];

export const launch = () => peers().chromium.launch({executablePath: CHROMIUM, args: ARGUMENTS});

/// {page, errors, requests}: errors of the page and its console, addresses that it asked for.
export async function open(browser, address, {width = 1366, height = 850, ...more} = {}) {
  const context = await browser.newContext({viewport: {width, height}, ...more});
  const page = await context.newPage(), errors = [], requests = [];
  page.on("console", message => ["error", "warning"].includes(message.type()) && !/GPU stall|GL Driver/.test(message.text()) && errors.push(message.text()));
  page.on("pageerror", error => errors.push(error.stack ?? error.message));
  page.on("request", request => requests.push(request.url()));
  page.on("websocket", socket => requests.push(socket.url()));
  await page.goto(address);
  return {page, errors, requests, context};
}
