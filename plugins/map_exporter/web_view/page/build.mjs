// SPDX-License-Identifier: BSD-3-Clause
// node build.mjs NODE_MODULES OUT.cpp: bundles the page and writes it as a C++ source. The packages lie
// in the build tree, so they are named.
import {readFileSync, writeFileSync} from "node:fs";
import {createRequire} from "node:module";
import {dirname, join} from "node:path";
import {fileURLToPath} from "node:url";

const [modules, out] = process.argv.slice(2), here = dirname(fileURLToPath(import.meta.url));
const esbuild = createRequire(join(modules, "x.js"))("esbuild");

const bundle = await esbuild.build({
  entryPoints: [join(here, "src/main.js")], nodePaths: [modules], bundle: true, minify: true, write: false,
  format: "iife", target: "es2022", legalComments: "eof", charset: "utf8"});

const files = {
  "index.html": readFileSync(join(here, "index.html"), "utf8"),
  "page.css": readFileSync(join(here, "page.css"), "utf8"),
  "page.js": bundle.outputFiles[0].text,
};

// Compilers limit the length of one literal; bytes that are no plain text are escaped.
const escaped = byte => byte === 10 ? "\\n" : byte === 34 ? "\\\"" : byte === 92 ? "\\\\" : byte === 63 ? "\\?" :
  byte >= 32 && byte < 127 ? String.fromCharCode(byte) : `\\${byte.toString(8).padStart(3, "0")}`;

function literal(text) {
  const bytes = Buffer.from(text, "utf8"), pieces = [];
  for (let at = 0; at < bytes.length; at += 8000)
    pieces.push(`.append("${Array.from(bytes.subarray(at, at + 8000), escaped).join("")}", ${Math.min(8000, bytes.length - at)})`);
  return `std::string()${pieces.join("\n")}`;
}

writeFileSync(out, `// SPDX-License-Identifier: BSD-3-Clause
// Made by page/build.mjs; page.js holds three.js (MIT, see its end).
#include "page_files.hpp"

namespace web_view {

const std::vector<std::pair<std::string, std::string>>& page_files() {
  static const std::vector<std::pair<std::string, std::string>> files = {
${Object.entries(files).map(([name, text]) => `{"${name}", ${literal(text)}}`).join(",\n")}};
  return files;
}

}  // namespace web_view
`);
