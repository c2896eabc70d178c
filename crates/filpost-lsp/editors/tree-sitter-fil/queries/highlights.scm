(comment) @comment
(string) @string
(free_text) @string
(file_name) @string
(number) @number
(continuation) @punctuation.delimiter
(unread) @comment

["CIMFIL" "SIMFIL" "MACRO" "TERMAC" "CALL" "RESERV" "PRINT" "REDEF" "TEXT" "FINI"] @keyword
["IF" "THEN" "ELSEIF" "ELSE" "ENDIF" "CASE" "WHEN" "ENDCAS"] @keyword
["DO" "CONTIN" "JUMPTO"] @keyword
"INCLUD" @keyword
[".AND." ".OR." ".NOT." "=" "+" "-" "*" "/" "**"] @operator
(relation) @operator
["(" ")" ","] @punctuation.delimiter

(name) @variable
(label (name) @label)
(label (number) @label)
(jump (name) @label)
(loop . "DO" . "/" . (name) @label)
(if_sign (name) @label)
(macro . (name) @function)
(call name: (name) @function)
(function name: (name) @function)
(post word: (name) @type)
(free word: (name) @type)
(section (name) @type)
(parameter (name) @variable.parameter)
((name) @constant (#match? @constant "^[Ee][Mm][Pp][Tt][Yy]$"))
