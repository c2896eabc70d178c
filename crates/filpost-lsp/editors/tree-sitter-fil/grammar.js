// FIL for tree-sitter: colors and structure while a text is typed. It is flat, a statement a line, as
// the parser of filpost reads it before it nests blocks; what is wrong in a text, the language server says.

/** A word in any case. */
function anyCase(text) {
  return new RegExp([...text].map((letter) => `[${letter}${letter.toLowerCase()}]`).join(''));
}

function word(text) {
  return alias(anyCase(text), text);
}

/** An operator between points. Of `5.EQ.6` the first point belongs to the number. */
function operator(text) {
  return alias(new RegExp(`\\.?${anyCase(text).source}\\.`), `.${text}.`);
}

const list = (rule) => seq(rule, repeat(seq(',', rule)));

/** Words that open a statement, and may be names of variables all the same. */
const STATEMENTS = ['IF', 'ELSEIF', 'ELSE', 'ENDIF', 'DO', 'CASE', 'WHEN', 'ENDCAS', 'JUMPTO', 'CALL', 'RESERV',
  'PRINT', 'REDEF', 'INCLUD', 'CONTIN', 'FINI', 'TERMAC', 'CIMFIL', 'SIMFIL', 'THEN'];

/** Words that take the rest of their line as it is. */
const FREE = ['PARTNO', 'PPRINT', 'INSERT', 'LETTER', 'REMARK', 'TITLES', 'TPRINT'];

module.exports = grammar({
  name: 'fil',

  extras: ($) => [/[ \t\f\x1a\uFEFF]/, $.comment, $.continuation],

  word: ($) => $.name,

  rules: {
    source_file: ($) => seq(repeat($._line), optional(choice($._statement, $.end))),

    _line: ($) => seq(optional($._statement), choice(/\r\n|\r|\n/, ';')),

    _statement: ($) => choice(
      seq($.label, optional($._unlabeled)),
      $._unlabeled,
    ),

    label: ($) => prec(1, seq(choice($.name, $.number), ')')),

    _unlabeled: ($) => choice(
      $._plain,
      $.section,
      $.if_block,
      $.if_one,
      $.if_sign,
      $.else_if,
      $.block_word,
      $.loop,
      $.case,
      $.when,
      $.macro,
      $.include,
    ),

    _plain: ($) => choice($.assignment, $.text, $.post, $.free, $.jump, $.call, $.declaration),

    section: ($) => seq(choice(word('CIMFIL'), word('SIMFIL')), '/', optional($._list)),
    if_block: ($) => seq($._condition, word('THEN')),
    if_one: ($) => seq($._condition, $._plain),
    if_sign: ($) => seq($._condition, $._label_name, ',', $._label_name, ',', $._label_name),
    _condition: ($) => seq(word('IF'), '(', $._expression, ')'),
    else_if: ($) => seq(word('ELSEIF'), '(', $._expression, ')', word('THEN')),
    block_word: ($) => choice(word('ELSE'), word('ENDIF'), word('ENDCAS'), word('TERMAC'), word('CONTIN')),
    loop: ($) => seq(word('DO'), '/', $._label_name, ',', $._target, '=', list($._expression)),
    case: ($) => seq(word('CASE'), '/', $._expression),
    when: ($) => seq(word('WHEN'), '/', optional($._list)),
    macro: ($) => seq($._target, '=', word('MACRO'), optional(seq('/', list($.parameter)))),
    parameter: ($) => seq($.name, optional(seq('=', $._expression))),
    include: ($) => seq(word('INCLUD'), '/', choice($.file_name, $.string)),
    // What stands behind FINI is not read.
    end: ($) => seq(word('FINI'), optional($.unread)),
    unread: () => token(prec(5, /[ \t]*(\$\$[^\r\n]*)?(\r\n|\r|\n|;)[^\u0000]*/)),

    assignment: ($) => seq($._target, '=', $._expression),
    text: ($) => seq($._target, '=', word('TEXT'), '/', optional($._list)),
    post: ($) => prec.right(choice(
      seq(field('word', $.name), optional(seq('/', optional($._list)))),
      seq(field('word', alias(choice(...FREE.map(anyCase)), $.name)), optional(seq('/', optional($._list)))),
      seq(field('word', alias(choice(...FREE.map(anyCase)), $.name)), $._list_of_texts),
    )),
    // PPRINT 'quoted' is the list PPRINT/'quoted'.
    _list_of_texts: ($) => seq($.string, repeat(seq(',', $._expression))),
    free: ($) => seq(field('word', alias(choice(...FREE.map(anyCase)), $.name)), $.free_text),
    free_text: () => token.immediate(prec(3, choice(
      /[ \t]+[^ \t\r\n;'$=\/][^\r\n$]*(\$[^\r\n$]+)*\$?/,
      /[ \t]+==[^\r\n$]*(\$[^\r\n$]+)*\$?/,
      /[ \t]*\/[ \t]*[^ \t\r\n;'$][^\r\n$]*(\$[^\r\n$]+)*\$?/,
    ))),
    jump: ($) => seq(word('JUMPTO'), '/', $._label_name),
    call: ($) => seq(word('CALL'), '/', field('name', $.name), repeat(seq(',', $.argument))),
    argument: ($) => choice($._expression, seq($.name, '=', $._expression)),
    declaration: ($) => seq(choice(word('RESERV'), word('PRINT'), word('REDEF')), '/', optional($._list)),

    _target: ($) => choice(
      $.name,
      alias(choice(...STATEMENTS.map(anyCase), ...FREE.map(anyCase)), $.name),
      $.element,
    ),
    element: ($) => seq($.name, '(', $._expression, ')'),
    _label_name: ($) => choice($.name, $.number),
    _list: ($) => list($._expression),

    _expression: ($) => choice(
      $.number,
      $.string,
      $.name,
      $.function,
      seq('(', $._expression, ')'),
      prec.left(1, seq($._expression, operator('OR'), $._expression)),
      prec.left(2, seq($._expression, operator('AND'), $._expression)),
      prec.right(3, seq(operator('NOT'), $._expression)),
      prec.left(4, seq($._expression, $.relation, $._expression)),
      prec.left(5, seq($._expression, choice('+', '-'), $._expression)),
      prec.left(6, seq($._expression, choice('*', '/'), $._expression)),
      prec.right(7, seq($._expression, '**', $._expression)),
      prec.right(8, seq(choice('+', '-'), $._expression)),
    ),
    relation: () => choice(...['EQ', 'NE', 'LT', 'LE', 'GT', 'GE'].map(operator)),
    function: ($) => seq(field('name', $.name), '(', optional($._list), ')'),

    name: () => /[A-Za-z_][A-Za-z0-9_]*/,
    number: () => /[0-9]+|([0-9]+\.[0-9]*|\.[0-9]+)([EeDd][+-]?[0-9]+)?|[0-9]+[EeDd][+-]?[0-9]+/,
    string: () => /'([^'\r\n]|'')*'/,
    file_name: () => /[^ \t\r\n;$']+/,
    comment: () => /\$\$[^\r\n]*/,
    continuation: () => token(prec(1, /\$([ \t]*|[ \t]+\$\$[^\r\n]*)(\r\n|\r|\n)/)),
  },
});
