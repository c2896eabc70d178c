// Answers requests of filpost.wasm: node answer.mjs WASM, a request a line in, an answer a
// line out.
import { readFileSync } from "node:fs";
import { createInterface } from "node:readline";
import { load } from "../../docs/playground/filpost.js";

const ask = await load(readFileSync(process.argv[2]));
for await (const line of createInterface({ input: process.stdin })) {
  let answer;
  try {
    answer = ask(JSON.parse(line));
  } catch (error) {
    answer = { trap: String(error) };
  }
  process.stdout.write(`${JSON.stringify(answer)}\n`);
}
