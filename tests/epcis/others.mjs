// SPDX-License-Identifier: Apache-2.0
// Checks Tagfield's output with third-party libraries, whose packages are in PACKAGES/node_modules:
//
//   node others.mjs PACKAGES epcis SCHEMA FILE   validates an EPCIS document, or each line of a .jsonl file, against
//                                                GS1's JSON schema
//   node others.mjs PACKAGES epc < URIS          prints a line of hexadecimal digits for each tag URI
//
// Exits with code 1 and lines on standard error if something is not valid.
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";

const [packages, verb, schema, file] = process.argv.slice(2);
const require = createRequire(path.resolve(packages, "package.json"));

function validate() {
  const Ajv = require("ajv").default;
  const ajv = new Ajv({ strict: false, allErrors: true });
  require("ajv-formats").default(ajv);
  const isValid = ajv.compile(JSON.parse(fs.readFileSync(schema, "utf8")));
  const text = fs.readFileSync(file, "utf8");
  const documents = file.endsWith(".jsonl") ? text.trimEnd().split("\n") : [text];
  for (const document of documents) {
    if (!isValid(JSON.parse(document))) {
      console.error(JSON.stringify(isValid.errors.slice(0, 3)));
      process.exitCode = 1;
    }
  }
}

function encode() {
  const epcTds = require("epc-tds");
  for (const uri of fs.readFileSync(0, "utf8").trimEnd().split("\n")) {
    console.log(epcTds.fromTagURI(uri).toHexString().toUpperCase());
  }
}

if (verb === "epcis") {
  validate();
} else {
  encode();
}
