// Colours of FIL, CL, machine.toml and NC texts. What is right or wrong filpost says.
import { HighlightStyle, StreamLanguage, syntaxHighlighting } from "@codemirror/language";
import { tags } from "@lezer/highlight";

const CALLS = /^(POSTF|POSTN|MACRO|TERMAC|CALL|IF|THEN|ELSE|ELSEIF|ENDIF|CASE|ENDCAS|DO|CONTIN|JUMPTO|CIMFIL|SIMFIL|REPEAT|PPRINT|INSERT|RESERV|TEXT|FINI|READ|WRITE|INCLUD|DATA|PRINT|OBTAIN|WHEN)\b/i;

/** Colours a line by rules, each a pattern and the kind of what it matches. */
function byRules(rules, comment) {
  return StreamLanguage.define({
    token(stream) {
      if (stream.eatSpace()) return null;
      for (const [pattern, kind] of rules) {
        if (stream.match(pattern)) return kind;
      }
      stream.next();
      return null;
    },
    languageData: { commentTokens: { line: comment } },
  });
}

const NUMBER = [/^(\d+\.?\d*|\.\d+)([ED][-+]?\d+)?/i, "number"];

export const fil = byRules(
  [
    [/^\$\$.*/, "comment"],
    [/^'[^']*'?/, "string"],
    [CALLS, "keyword"],
    [/^\.[A-Z]+\./i, "operator"],
    [/^[A-Z_][A-Z0-9_]*F(?=\()/i, "variableName.function"],
    [/^[A-Z_][A-Z0-9_]*/i, "variableName"],
    NUMBER,
  ],
  "$$",
);

export const cl = byRules(
  [
    [/^\$\$.*/, "comment"],
    [/^(GOTO|FROM|GODLTA|CIRCLE|CYCLE|RAPID|FEDRAT|SPINDL|LOADTL|TOOLNO|FINI|UNITS|PARTNO|MACHIN|COOLNT)\b/i, "keyword"],
    [/^[A-Z][A-Z0-9]*/i, "variableName"],
    NUMBER,
  ],
  "$$",
);

export const machine = byRules(
  [
    [/^#.*/, "comment"],
    [/^"[^"]*"?/, "string"],
    [/^\[[^\]]*\]/, "keyword"],
    [/^[a-z_][a-z0-9_.-]*(?=\s*=)/i, "propertyName"],
    NUMBER,
  ],
  "#",
);

export const nc = byRules(
  [
    [/^\([^)]*\)?/, "comment"],
    [/^;.*/, "comment"],
    [/^N\d+/i, "meta"],
    [/^[GM]\d+(\.\d+)?/i, "keyword"],
    [/^[A-Z]+\d*=/i, "variableName"],
    [/^[A-Z]+/i, "variableName"],
    [/^[-+]?(\d+\.?\d*|\.\d+)/, "number"],
  ],
  ";",
);

const LANGUAGES = { fil, cl, machine, toml: machine, nc };

/** The colours of a kind of text; none for a plain one. */
export const languageOf = (kind) => LANGUAGES[kind] ?? [];

/** The colours of the kinds of words, which the style sheet has for light and dark. */
export const wordColours = syntaxHighlighting(HighlightStyle.define([
  { tag: tags.comment, color: "var(--code-comment)" },
  { tag: tags.string, color: "var(--code-string)" },
  { tag: tags.keyword, color: "var(--code-keyword)" },
  { tag: tags.number, color: "var(--code-number)" },
  { tag: tags.propertyName, color: "var(--code-name)" },
  { tag: tags.function(tags.variableName), color: "var(--code-name)" },
  { tag: tags.meta, color: "var(--quiet)" },
]));
