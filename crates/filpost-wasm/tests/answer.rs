//! Requests and their answers, as a page gets them.

use serde_json::{Value, json};

const CL: &str = "UNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";

fn ask(request: &Value) -> Value {
    serde_json::from_slice(&filpost_wasm::answer(request.to_string().as_bytes())).unwrap()
}

#[test]
fn a_program_comes_with_what_made_its_lines() {
    let fil = "CIMFIL/ON,LOADTL\nDMY=POSTF(13)\nPOSTN/OUT,G,0,G,43,Z,100,H,1\nCIMFIL/OFF\nFINI\n";
    let answer = ask(&json!({
        "do": "post", "ready": "fanuc-mill", "cl": CL,
        "fil": [{ "name": "raise.fil", "text": fil }],
    }));
    let nc: Vec<&str> = answer["nc"].as_str().unwrap().lines().collect();
    let origins = answer["origins"].as_array().unwrap();
    let lines = origins.iter().map(|origin| origin.as_u64().unwrap_or(1));
    assert_eq!(nc.len() as u64, lines.sum::<u64>());
    let raised = nc.iter().position(|line| line.contains("Z100.")).unwrap();
    assert_eq!(origins[raised], json!([2, 2, [["raise.fil", 3]]]));
    let goto = nc.iter().position(|line| line.contains("X1. Y2.")).unwrap();
    assert_eq!(origins[goto], json!([4, 4, []]));
    // A row of lines, each of the next record on the next line, is said by its number.
    let longer = CL.replace("FINI", "GOTO / 5, 2, 3\nGOTO / 6, 2, 3\nFINI");
    let longer = ask(&json!({ "do": "post", "ready": "fanuc-mill", "cl": longer }));
    let at = longer["nc"].as_str().unwrap().lines().position(|line| line.contains("X5.")).unwrap();
    assert_eq!(longer["origins"][at - 1], json!([4, 4, []]));
    // Both points, and the first block of FINI.
    assert_eq!(longer["origins"][at], 3);
    assert_eq!(answer["records"], 5);
    let plot = ask(&json!({
        "do": "plot", "ready": "fanuc-mill", "cl": CL, "nc": answer["nc"], "origins": origins,
        "fil": [{ "name": "raise.fil", "text": fil }],
    }));
    assert!(plot["page"].as_str().unwrap().contains("<canvas"), "{plot}");
    let unknown = ask(&json!({ "do": "plot", "ready": "no-such-mill", "nc": "%" }));
    assert_eq!(unknown["errors"][0]["code"], "E0703");
}

/// The head of columns: JSON after a mark and its length.
fn head(answer: &Value) -> Value {
    let base64 = answer["columns"].as_str().unwrap_or_else(|| panic!("{answer}"));
    let digit = |byte: u8| match byte {
        b'A'..=b'Z' => byte - b'A',
        b'a'..=b'z' => byte - b'a' + 26,
        b'0'..=b'9' => byte - b'0' + 52,
        b'+' => 62,
        _ => 63,
    };
    let mut bytes = Vec::new();
    for four in base64.trim_end_matches('=').as_bytes().chunks(4) {
        let bits = four.iter().fold(0u32, |bits, byte| bits << 6 | u32::from(digit(*byte)));
        let bits = bits << (6 * (4 - four.len()) + 8);
        bytes.extend(&bits.to_be_bytes()[..four.len() * 6 / 8]);
    }
    assert_eq!(&bytes[..4], b"FPV1");
    let length = u32::from_le_bytes(bytes[4..8].try_into().unwrap()) as usize;
    serde_json::from_slice(&bytes[8..8 + length]).unwrap()
}

#[test]
fn the_path_of_a_program_comes_as_columns_with_the_tools_of_its_cl_file() {
    let cl = "UNITS / MM\nCUTTER / 10, 2\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\n\
              GOTO / 4, 2, 3\nFINI\n";
    let nc = ask(&json!({ "do": "post", "ready": "fanuc-mill", "cl": cl }))["nc"].clone();
    let program = ask(&json!({ "do": "columns", "ready": "fanuc-mill", "nc": nc, "cl": cl }));
    let program = head(&program);
    assert_eq!(program["columns"]["lines"][2], 1);
    assert_eq!(program["columns"]["points"][2], 6);
    let tool = json!({ "number": 1, "diameter": 10, "corner": 2, "bottom": 0, "length": null });
    assert_eq!(program["tools"], json!([tool]));
    assert_eq!(program["leftOut"], json!([]));
    let cl_path = head(&ask(&json!({ "do": "columns", "ready": "fanuc-mill", "cl": cl })));
    assert_eq!(cl_path["columns"]["lines"][2], 1);
    let part = nc.as_str().unwrap().replace("M30", "G65 P1\nM30");
    let part = ask(&json!({ "do": "columns", "ready": "fanuc-mill", "nc": part }));
    assert_eq!(head(&part)["leftOut"][0]["why"], "the machine has no G65");
}

#[test]
fn what_is_refused_has_no_program() {
    let wrong = CL.replace("GOTO / 1", "GOTO / 1,1");
    let answer = ask(&json!({ "do": "post", "ready": "fanuc-mill", "cl": wrong }));
    assert!(answer.get("nc").is_none());
    assert_eq!(answer["errors"][0]["code"], "E0407");
    assert_eq!(answer["errors"][0]["places"][0]["line"], 4);
    let answer = ask(&json!({ "do": "post", "ready": "no-such-mill", "cl": CL }));
    assert_eq!(answer["errors"][0]["code"], "E0703");
}

#[test]
fn a_script_gets_no_file() {
    let fil = "CIMFIL/ON,LOADTL\nST=FILEF(1,READ,'tools.txt')\nCIMFIL/OFF\nFINI\n";
    let answer = ask(&json!({
        "do": "post", "cl": CL, "fil": [{ "name": "read.fil", "text": fil }],
    }));
    assert_eq!(answer["errors"][0]["code"], "E0321", "{answer}");
}

#[test]
fn included_texts_come_from_the_request() {
    let job = |includes: Value| {
        let fil =
            "INCLUD/more.fil\nCIMFIL/ON,LOADTL\nCALL/GREET\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
        json!({
            "do": "post", "cl": CL, "fil": [{ "name": "main.fil", "text": fil }],
            "includes": includes,
        })
    };
    let more = json!([{ "name": "more.fil", "text": "GREET=MACRO\nPPRINT/'HELLO'\nTERMAC\n" }]);
    let answer = ask(&job(more));
    assert!(answer["nc"].as_str().is_some_and(|nc| nc.contains("(HELLO)")), "{answer}");
    assert_eq!(ask(&job(json!([])))["errors"][0]["code"], "E0214");
}

#[test]
fn places_count_as_pages_count() {
    let cl = CL.replace("FINI", "$$ \u{1f600}\nCOOLNT / \u{1f600}\nFINI");
    let answer = ask(&json!({ "do": "post", "cl": cl }));
    let place = &answer["errors"][0]["places"][0];
    assert_eq!(place["line"], 6, "{answer}");
    assert!(place["to"].as_u64().unwrap() <= "COOLNT / \u{1f600}".encode_utf16().count() as u64);
}

#[test]
fn an_editor_is_answered() {
    let text = "XX=SQRTF(4)\nYY=XX+\nFINI\n";
    let edited = |what: &str, line: u32, character: u32| {
        ask(&json!({
            "do": what, "language": "fil", "name": "a.fil", "text": text,
            "line": line, "character": character,
        }))
    };
    let findings = edited("findings", 0, 0);
    assert_eq!(findings[0]["severity"], "error");
    assert_eq!(findings[0]["range"][0], 1);
    assert!(edited("hover", 0, 5)["markdown"].as_str().unwrap().contains("square root"));
    let labels = edited("complete", 0, 6).to_string();
    assert!(labels.contains("SQRTF"), "{labels}");
    let machine = |what: &str| {
        ask(&json!({
            "do": what, "language": "machine", "name": "machine.toml",
            "text": "base = \"fanuc-mill\"\nrapid.split = 1\nrapid.splat = 1\n",
            "line": 1, "character": 3,
        }))
    };
    assert_eq!(machine("findings").as_array().unwrap().len(), 1);
    assert!(machine("hover")["markdown"].is_string());
    let cl =
        ask(&json!({ "do": "hover", "language": "cl", "name": "a.ncl", "text": CL, "line": 3 }));
    assert!(cl["markdown"].as_str().unwrap().contains("GOTO"));
}

#[test]
fn what_is_no_request_is_said() {
    for request in
        ["", "{}", "[1]", r#"{"do": "dance"}"#, r#"{"do": "post", "cl": "", "clock": "noon"}"#]
    {
        let answer = filpost_wasm::answer(request.as_bytes());
        let answer: Value = serde_json::from_slice(&answer).unwrap();
        assert!(answer["misuse"].is_string(), "{request}: {answer}");
    }
    let misspelled = ask(&json!({ "do": "post", "cl": CL, "machin": "x" }));
    assert!(misspelled["misuse"].as_str().unwrap().contains("machin"));
}

#[test]
fn every_ready_post_is_there() {
    let posts = ask(&json!({ "do": "ready" }));
    assert_eq!(posts.as_array().unwrap().len(), filpost::ready::READY.len());
}

#[test]
fn a_program_cuts_stock() {
    let nc = "G21 G90 G94 G17\nT1 M6\nS900 M3\nG0 X-10. Y10.\nG43 Z20. H1\nZ-2.\nG1 X60. F200.\n\
              G0 X-10. Y15.\nM30\n";
    let answer = ask(&json!({
        "do": "simulate", "ready": "fanuc-mill", "nc": nc, "stock": "box 50x20x10",
        "tools": ["1=D10"], "grid": "0.5mm", "heights": true,
    }));
    assert_eq!(answer["findings"][0]["code"], "E0971", "{answer}");
    assert_eq!(answer["findings"][0]["nc_line"], 8);
    let (columns, rows) = (&answer["grid"]["columns"], &answer["grid"]["rows"]);
    assert_eq!((columns, rows), (&json!(100), &json!(40)));
    let heights = answer["heights"].as_array().unwrap();
    assert_eq!(
        (heights.len(), &heights[0], &heights[20 * 100 + 7]),
        (4000, &json!(0.0), &json!(-2.0))
    );
    let refused = ask(&json!({
        "do": "simulate", "ready": "fanuc-mill", "nc": nc, "stock": "box 50x20x10", "tools": [],
    }));
    assert_eq!(refused["errors"][0]["code"], "E0961", "{refused}");
}
