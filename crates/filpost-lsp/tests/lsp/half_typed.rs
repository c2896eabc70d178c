//! Half-typed files: the published scripts cut at a byte, or with a line cut there. Nothing
//! panics, and no answer lies outside of the file. `FILPOST_HALF_TYPED=all` looks at each
//! byte, the normal run at some.

use std::fs;

use fil_ide::{Range, Script, Text};
use filpost_tests::root;
use serde_json::{Value, json};

use filpost_lsp::Server;

/// Every so many bytes in the normal run.
const SAMPLE: usize = 211;

fn scripts() -> Vec<(String, String)> {
    let mut found = Vec::new();
    for folder in ["fil-scripts/papers", "fil-scripts/papers/screw"] {
        for entry in fs::read_dir(root().join(folder)).expect("the scripts").flatten() {
            if entry.path().extension().is_some_and(|end| end == "fil") {
                let text = fs::read_to_string(entry.path()).expect("a script");
                found.push((entry.path().display().to_string(), text));
            }
        }
    }
    found.sort();
    found
}

/// Asks everything at the end of `head` in a text.
fn look(name: &str, text: &str, at: usize) {
    let script = Script::new(&[("post.fil", text)], "post.fil", None, None);
    let places = Text::new(text);
    let last = places.whole().end;
    let inside = |range: Range| {
        assert!(range.start <= range.end && range.end <= last, "{name} {at}: {range:?} {last:?}");
    };
    let position = places.position(at);
    script.findings().iter().for_each(|finding| inside(finding.range));
    script.complete(position).iter().for_each(|item| inside(item.range));
    if let Some((_, range)) = script.hover(position) {
        inside(range);
    }
    script.signature(position);
    script.definition(position).iter().for_each(|place| inside(place.range));
    script.references(position, true).iter().for_each(|place| inside(place.range));
    if let Ok(edits) = script.rename(position, "QQQQ1") {
        edits.iter().for_each(|edit| inside(edit.place.range));
    }
    script.outline().iter().for_each(|entry| inside(entry.whole));
    script.tokens().iter().for_each(|token| {
        inside(token.range);
        assert_eq!(token.range.start.line, token.range.end.line);
    });
    script.inlays().iter().for_each(|inlay| assert!(inlay.position <= last));
    script
        .folds()
        .iter()
        .for_each(|fold| assert!(fold.first < fold.last && fold.last <= last.line));
    script.fixes(Range { start: position, end: position });
}

#[test]
fn no_cut_of_a_published_script_panics_or_points_outside() {
    let step = match std::env::var("FILPOST_HALF_TYPED") {
        Ok(all) if all == "all" => 1,
        _ => SAMPLE,
    };
    for (name, text) in scripts() {
        let cuts = (0..=text.len()).filter(|at| text.is_char_boundary(*at));
        for (index, at) in cuts.enumerate() {
            if index % step != 0 {
                continue;
            }
            look(&name, &text[..at], at);
            let end = text[at..].find('\n').map_or(text.len(), |end| at + end);
            look(&name, &format!("{}{}", &text[..at], &text[end..]), at);
        }
    }
}

/// Broken texts, wide characters and wrong places.
#[test]
fn odd_texts_and_places_have_answers() {
    let texts = [
        "",
        "\u{feff}",
        "\u{feff}NN=1",
        "'",
        "$",
        "$$",
        "IF(",
        "POSTF(",
        "XX=POSTF(1,2",
        "CALL/",
        "WHEN/ICODEF(",
        "𝛑𝛑𝛑",
        "PPRINT/'𝛑",
        ";;;;",
        ")))",
        "(((",
        "\r\n\r\n",
        "A)B)C)",
        "CIMFIL/ON,",
        "NN=1\r\nXX=NN\r\n",
        "\0\u{1}",
        "M=MACRO/",
        "DO/L,I=1,",
        "INCLUD/x.fil",
        "$ $ $",
        "\t\t$\n\t$\n",
        "COMF('",
        "XX=COMF('a.b",
        "IF(1)IF(2)IF(3)",
        "é=1",
        "POSTF(é,1,2)",
        "XX=POSTF(2,3,é",
    ];
    for text in texts {
        for at in (0..=text.len()).filter(|at| text.is_char_boundary(*at)) {
            look("odd", text, at);
        }
        let mut server = Server::new(&Value::Null);
        for (uri, language) in
            [("untitled:a", "fil"), ("file:///machine.toml", "toml"), ("file:///a.ncl", "cl")]
        {
            let document =
                json!({ "uri": uri, "languageId": language, "version": 1, "text": text });
            server.notification("textDocument/didOpen", &json!({ "textDocument": document }));
            for (line, character) in [(0, 0), (0, 1), (0, u32::MAX), (u32::MAX, 0), (1, 3), (7, 7)]
            {
                let place = json!({ "line": line, "character": character });
                let params = json!({
                    "textDocument": { "uri": uri },
                    "position": place,
                    "range": { "start": place, "end": place },
                    "newName": "QQQQ1",
                });
                for method in [
                    "hover",
                    "completion",
                    "signatureHelp",
                    "definition",
                    "references",
                    "prepareRename",
                    "rename",
                    "documentSymbol",
                    "foldingRange",
                    "formatting",
                    "inlayHint",
                    "codeAction",
                    "semanticTokens/full",
                ] {
                    let _ = server.request(&format!("textDocument/{method}"), &params);
                }
            }
        }
    }
}

/// A keystroke in a script of 5,000 lines: diagnostics, completion and tokens.
#[test]
fn a_keystroke_in_a_long_script_is_answered_soon() {
    let sections: String = (0..500)
        .map(|number| {
            format!(
                "M{number}=MACRO/PA,PB\n  XA{number}=PA+PB\n  IF(XA{number}.GT.1)THEN\n    \
                 XB{number}=SQRTF(XA{number})\n  ELSE\n    XB{number}=POSTF(1,3,487)\n  ENDIF\n  \
                 $$ comment\n  XC{number}=XB{number}*2\nTERMAC\n"
            )
        })
        .collect();
    let text = format!("{sections}XX=\nFINI\n");
    let mut server = Server::new(&Value::Null);
    let document = json!({ "uri": "untitled:a", "languageId": "fil", "version": 1, "text": text });
    server.notification("textDocument/didOpen", &json!({ "textDocument": document }));
    let mut times: Vec<f64> = (0..9)
        .map(|round| {
            let text = format!("{sections}XX=XC{round}\nFINI\n");
            let start = std::time::Instant::now();
            server.notification(
                "textDocument/didChange",
                &json!({ "textDocument": { "uri": "untitled:a" }, "contentChanges": [{ "text": text }] }),
            );
            let place = json!({ "line": 5000, "character": 6 });
            let params = json!({ "textDocument": { "uri": "untitled:a" }, "position": place });
            server.request("textDocument/completion", &params).expect("answered");
            start.elapsed().as_secs_f64() * 1000.0
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!("a keystroke: {:.1} ms in the middle of {times:.1?}", times[4]);
    // 20 ms are asked of a release build; this one is not optimized, on a busy machine.
    assert!(times[0] < 400.0, "{times:?}");
}
