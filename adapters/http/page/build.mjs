// SPDX-License-Identifier: Apache-2.0
// Bundles the page into one self-contained HTML file with inline script and style, which loads
// nothing else from the network.
//
//   node build.mjs OUT.html [--modules DIR]
//
// The server serves it. A report embeds its script, which then shows the run from <script
// type="application/json" id="tagfield-run">. DIR contains node_modules (default: this folder).

import {createHash} from "node:crypto";
import {readFileSync, writeFileSync} from "node:fs";
import {createRequire} from "node:module";
import path from "node:path";
import {fileURLToPath, pathToFileURL} from "node:url";

const HERE = path.dirname(fileURLToPath(import.meta.url));

function usage() {
  console.error("usage: node build.mjs OUT.html [--modules DIR]");
  process.exit(2);
}

function parse(words) {
  let output = null;
  let modules = HERE;
  for (let i = 0; i < words.length; ++i) {
    if (words[i] === "--modules" && i + 1 < words.length)
      modules = path.resolve(words[++i]);
    else if (output === null && !words[i].startsWith("-"))
      output = words[i];
    else
      usage();
  }
  return output === null ? usage() : {output, modules};
}

async function bundle(modules) {
  const found = createRequire(path.join(modules, "package.json")).resolve("esbuild");
  const {build} = (await import(pathToFileURL(found))).default;
  const result = await build({
    entryPoints: [path.join(HERE, "src/main.js")],
    bundle: true,
    minify: true,
    write: false,
    format: "iife",
    target: "es2022",
    charset: "utf8",
    loader: {".css": "text"},
    nodePaths: [path.join(modules, "node_modules")],
    legalComments: "inline",
    logLevel: "warning"
  });
  return result.outputFiles[0]
    .text.replaceAll("</script", "<\\/script")
    .replaceAll("<!--", "<\\!--");
}

const {output, modules} = parse(process.argv.slice(2));
const script = await bundle(modules);
const hash = createHash("sha256").update(script).digest("base64");
const page = readFileSync(path.join(HERE, "page.html"), "utf8").replace("SCRIPT_HASH", hash);
// A replacement function, as "$" in the script must not be interpreted as a pattern.
writeFileSync(output, page.replace("<!--script-->", () => `<script>${script}</script>`));
