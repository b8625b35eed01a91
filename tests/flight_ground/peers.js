/// The npm packages that scripts/setup --peers fetched; a test without them is skipped with a line (77 for ctest).

import {existsSync} from "node:fs";
import {createRequire} from "node:module";
import {fileURLToPath} from "node:url";

const FOLDER = fileURLToPath(new URL("../../build/npm/flight_ground/", import.meta.url));

export function peers() {
  if (!existsSync(`${FOLDER}node_modules/ajv`)) {
    console.log("skipped: npm packages missing; scripts/setup --peers installs them");
    process.exit(77);
  }
  const require = createRequire(`${FOLDER}package.json`);
  return {...require("@foxglove/ws-protocol"), ...require("ws"), ...require("@mcap/core"), fzstd: require("fzstd"),
          official: require("@foxglove/schemas/jsonschema"), Ajv: require("ajv").default};
}

/// What a schema says against a message, in one line; "" where it says nothing.
export class Schemas {
  constructor({Ajv, official}) {
    this.ajv = new Ajv({strict: false, allErrors: true, validateFormats: false});
    this.official = new Map(Object.values(official).filter((s) => s?.title).map((s) => [s.title, s]));
    this.checks = new Map();
  }

  check(key, schema) {
    if (!this.checks.has(key)) this.checks.set(key, this.ajv.compile(schema));
    return this.checks.get(key);
  }

  /// By the schema that came with the channel and, of Foxglove's messages, by Foxglove's own too.
  wrong(schemaName, schema, message) {
    const faults = [];
    const own = this.check(`own ${schemaName} ${schema}`, JSON.parse(schema));
    if (!own(message)) faults.push(this.ajv.errorsText(own.errors));
    if (schemaName.startsWith("foxglove.")) {
      if (!this.official.has(schemaName)) return `${schemaName} is no schema of Foxglove's`;
      const theirs = this.check(`official ${schemaName}`, this.official.get(schemaName));
      if (!theirs(message)) faults.push(`Foxglove's own: ${this.ajv.errorsText(theirs.errors)}`);
    }
    return faults.join("; ");
  }
}
