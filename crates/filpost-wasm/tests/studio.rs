//! What the page of the studio asks: a new post, its form, edits of settings, repairs, checks.

use serde_json::{Value, json};

fn ask(request: Value) -> Value {
    filpost_wasm::answer_to(request)
}

/// The files of a new post by their names.
fn new_post(base: &str) -> impl Fn(&str) -> String {
    let made = ask(json!({ "do": "new", "name": "mine", "base": base }));
    move |name: &str| {
        let files = made["files"].as_array().expect("files");
        let file = files.iter().find(|file| file["name"] == name).expect("the file");
        file["text"].as_str().expect("a text").to_string()
    }
}

fn file(name: &str, text: &str) -> Value {
    json!({ "name": name, "text": text })
}

#[test]
fn a_new_post_gives_the_program_of_its_first_case() {
    let text = new_post("haas-mill");
    let posted = ask(json!({
        "do": "post", "cl": text("cases/first/part.ncl"), "cl_name": "part.ncl",
        "machine": file("machine.toml", &text("machine.toml")),
        "fil": [file("post.fil", &text("post.fil"))],
    }));
    assert_eq!(posted["nc"], text("cases/first/expected.nc"));
    let wrong = ask(json!({ "do": "new", "name": "mine", "base": "no-such-post" }));
    assert_eq!(wrong["errors"][0]["code"], "E0703");
}

/// The row of a setting.
fn row<'f>(form: &'f Value, key: &str) -> &'f Value {
    let rows = form["settings"].as_array().expect("settings");
    rows.iter().find(|row| row["key"] == key).expect("the row")
}

#[test]
fn the_form_tells_what_is_set_here_and_what_the_base_has() {
    let text = "base = \"haas-mill\"\nseqno.increment = 5\n\n[options]\nstyle = \"production\"\n";
    let form = ask(json!({ "do": "form", "text": text }));
    let increment = row(&form, "seqno.increment");
    assert_eq!(increment["own"], "5");
    assert_eq!((&increment["value"], &increment["base"]), (&json!(5.0), &json!(10.0)));
    let split = row(&form, "rapid.split");
    assert_eq!((&split["own"], &split["value"]), (&Value::Null, &json!(1.0)));
    assert!(split["choices"].as_array().is_some_and(|choices| choices.len() > 1));
    let style = form["options"]
        .as_array()
        .expect("options")
        .iter()
        .find(|option| option["name"] == "style");
    let style = style.expect("the option");
    assert_eq!(style["value"], "production");
    assert_eq!(form["base"], "haas-mill");
    let wrong = ask(json!({ "do": "form", "text": "seqno.incremnt = 5\n" }));
    assert_eq!(wrong["errors"][0]["code"], "E0604");
}

#[test]
fn a_setting_is_written_and_taken_back() {
    let text = "# mine\nbase = \"haas-mill\"\n\n[limits]\nx_max = 1 # of the hall\n";
    let set = |text: &str, key: &str, value: Option<&str>| {
        ask(json!({ "do": "set", "text": text, "key": key, "value": value }))
    };
    let other = set(text, "limits.x_max", Some("400"));
    assert_eq!(other["text"], text.replace("x_max = 1 ", "x_max = 400 "));
    let more = set(text, "seqno.increment", Some("5"));
    assert!(more["text"].as_str().expect("a text").ends_with("[seqno]\nincrement = 5\n"), "{more}");
    let back = set(more["text"].as_str().expect("a text"), "seqno.increment", None);
    assert!(!back["text"].as_str().expect("a text").contains("increment"));
    assert!(set(text, "seqno.increment", Some("\"many\""))["why"].is_string());
    assert!(set(text, "no.such", Some("1"))["why"].is_string());
}

#[test]
fn a_repair_brings_its_edit() {
    let fixes = ask(json!({
        "do": "fixes", "language": "fil", "name": "post.fil", "text": "XX = SQRTFF(4)\nFINI\n",
    }));
    let fix = &fixes[0];
    assert_eq!((&fix["title"], &fix["line"]), (&json!("write SQRTF"), &json!(0)));
    assert_eq!(fix["edits"][0]["text"], "SQRTF");
    let fixes = ask(json!({
        "do": "fixes", "language": "machine", "name": "machine.toml", "text": "seqno.incremnt = 5\n",
    }));
    assert_eq!(fixes[0]["edits"][0]["text"], "seqno.increment");
}

#[test]
fn a_case_is_read() {
    let case = ask(json!({ "do": "case", "text": "cl = \"a.ncl\"\nfil = [\"b.fil\"]\n" }));
    assert_eq!(case["case"], json!({ "cl": "a.ncl", "fil": ["b.fil"] }));
    assert!(ask(json!({ "do": "case", "text": "cl = " }))["why"].is_string());
}

const CL: &str = "UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\nFEDRAT / 200, MMPM\n\
                  GOTO / 0, 0, 5\nGOTO / 10, 0, 5\nCIRCLE / 10, 10, 5, 0, 0, 1, 10\nGOTO / 20, 10, 5\nFINI\n";

fn posted() -> String {
    let posted = ask(json!({ "do": "post", "ready": "fanuc-mill", "cl": CL }));
    posted["nc"].as_str().expect("a program").to_string()
}

#[test]
fn a_program_is_checked_against_its_cl_file() {
    let verify =
        |nc: &str| ask(json!({ "do": "verify", "ready": "fanuc-mill", "cl": CL, "nc": nc }));
    let right = verify(&posted());
    assert_eq!(right["verdict"], "agrees", "{right}");
    let wrong = verify(&posted().replace("Z5.", "Z6."));
    assert_eq!(wrong["verdict"], "differs", "{wrong}");
    assert!(wrong["findings"][0]["nc_line"].is_u64());
}

#[test]
fn two_programs_are_compared_in_words() {
    let nc = posted();
    let compare = |other: &str| {
        ask(json!({ "do": "compare", "ready": "fanuc-mill", "nc": nc, "other": other }))
    };
    assert_eq!(compare(&nc)["equal"], true);
    let found = compare(&nc.replace("Z5.", "Z6."));
    assert!(
        found["differences"][0]["message"].as_str().is_some_and(|said| said.contains('Z')),
        "{found}"
    );
}

fn bytes(text: &Value) -> Vec<u8> {
    let digits = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut bits = 0_u32;
    let mut count = 0;
    let mut bytes = Vec::new();
    for letter in text.as_str().expect("base64").bytes().filter(|letter| *letter != b'=') {
        let digit = digits.iter().position(|digit| *digit == letter).expect("a digit");
        bits = (bits << 6 | digit as u32) & 0xff_ffff;
        count += 6;
        if count >= 8 {
            count -= 8;
            bytes.push((bits >> count) as u8);
        }
    }
    bytes
}

#[test]
fn the_motions_of_a_program_are_arrays_of_one_length() {
    let nc = posted();
    let made = ask(json!({ "do": "motions", "ready": "fanuc-mill", "nc": nc }));
    let count = made["count"].as_u64().expect("a count") as usize;
    let lengths =
        ["kind", "jump", "tool", "line", "feed", "points"].map(|key| bytes(&made[key]).len());
    assert_eq!(lengths, [count, count, 2 * count, 4 * count, 4 * count, 12 * count]);
    let points = bytes(&made["points"]);
    let number =
        |at: usize| f32::from_le_bytes(points[4 * at..4 * at + 4].try_into().expect("four"));
    let last = [0, 1, 2].map(|axis| number(3 * (count - 1) + axis));
    assert_eq!(last, [20.0, 10.0, 5.0]);
    assert!(bytes(&made["kind"]).contains(&2), "the arc has chords");
    let lines = nc.lines().count() as u32;
    let line = bytes(&made["line"]);
    let all = line.chunks(4).map(|four| u32::from_le_bytes(four.try_into().expect("four")));
    assert!(all.into_iter().all(|line| (1..=lines).contains(&line)));
    // An axis array is there for a machine that tilts its tool alone.
    assert_eq!(bytes(&made["axis"]).len(), 0);
}

/// A request to debug the first case of a new post.
fn debugged(text: &dyn Fn(&str) -> String, more: Value) -> Value {
    let mut request = json!({
        "do": "debug", "cl": text("cases/first/part.ncl"), "cl_name": "part.ncl",
        "machine": file("machine.toml", &text("machine.toml")),
        "fil": [file("post.fil", &text("post.fil"))],
    });
    for (key, value) in more.as_object().expect("an object") {
        request[key] = value.clone();
    }
    ask(request)
}

#[test]
fn a_run_stops_where_it_is_asked_to_and_goes_on_from_there() {
    let text = new_post("haas-mill");
    let fil = text("post.fil");
    let line = 1 + fil.lines().position(|line| line.contains("HTEXT =")).expect("the line");
    let stops = json!([{ "file": "post.fil", "line": line }, { "file": "other.fil", "line": 1 }]);
    let value = |answer: &Value, name: &str| {
        let scopes = answer["scopes"].as_array().expect("scopes").iter();
        let all = scopes.flat_map(|scope| scope["variables"].as_array().expect("values"));
        let found = all.clone().find(|value| value["name"] == name).expect("the name");
        found["value"].as_str().expect("a text").to_string()
    };
    let first = debugged(&text, json!({ "breakpoints": stops, "step": "run" }));
    assert_eq!(first["placed"][0]["line"], line);
    assert!(first["placed"][1]["why"].is_string(), "{}", first["placed"]);
    assert_eq!(first["stopped"]["hits"], json!([0]));
    assert_eq!(first["frames"][0]["source"]["path"], "post.fil");
    assert_eq!(first["frames"][0]["line"], line);
    let before = value(&first, "HTEXT");
    let here = &first["stopped"]["here"];
    let next = debugged(
        &text,
        json!({ "from": here, "step": "over", "watched": ["POSTF(7,1)", "1+1", "NOSUCH"] }),
    );
    assert_eq!(next["stopped"]["reason"], "step");
    assert_ne!(value(&next, "HTEXT"), before);
    assert_eq!(next["watched"][1]["value"], "2");
    assert!(next["watched"][2]["why"].is_string());
    let back = debugged(&text, json!({ "from": next["stopped"]["back"], "step": "here" }));
    assert_eq!(back["stopped"]["here"], *here);
    assert_eq!(value(&back, "HTEXT"), before);
    let over = debugged(&text, json!({ "from": here, "step": "run" }));
    assert!(over["stopped"].is_null() && over["refusal"].is_null(), "{over}");
}

#[test]
fn a_breakpoint_in_a_block_stops_at_that_line_of_the_program() {
    let text = new_post("haas-mill");
    let program = text("cases/first/expected.nc");
    for (number, block) in (1..).zip(program.lines()) {
        let answer = debugged(&text, json!({ "breakpoints": [{ "nc": number }] }));
        assert_eq!(answer["stopped"]["text"], block, "line {number}");
        assert_eq!(answer["stopped"]["hits"], json!([0]));
    }
    let condition =
        json!({ "breakpoints": [{ "name": "record GOTO", "condition": "POSTF(7,6).LT.0" }] });
    let answer = debugged(&text, condition);
    assert_eq!(answer["frames"][0]["name"].as_str().map(|name| name.contains("GOTO")), Some(true));
    let wrong = debugged(&text, json!({ "step": "sideways" }));
    assert!(wrong["misuse"].as_str().is_some_and(|why| why.contains("sideways")));
    let refused = debugged(&text, json!({ "cl": "UNITS / MM\nGOTO / 1, 2, 3\n" }));
    assert_eq!(refused["stopped"]["reason"], "exception", "{refused}");
}

#[test]
fn an_audit_tells_what_a_script_changed() {
    let audit = |fil: &str| {
        ask(json!({
            "do": "audit", "ready": "fanuc-mill", "cl": CL, "fil": [file("post.fil", fil)],
        }))
    };
    let plain = audit("FINI\n");
    assert_eq!((&plain["verdict"], &plain["changes"]), (&json!("unchanged"), &json!([])));
    assert_eq!(plain["motions"]["asked"], plain["motions"]["made"]);
    let changed = audit("CIMFIL/ON,SPINDL\nPOSTN/OUT,S,1200,M,3\nCIMFIL/OFF\nFINI\n");
    assert_eq!(changed["verdict"], "changed", "{changed}");
    let change = &changed["changes"][0];
    assert_eq!(change["author"]["file"], "post.fil");
    assert_eq!(change["author"]["line"], 2);
    assert_eq!(change["cl_lines"], json!([3]));
    let refused = audit("XX = SQRTFF(4)\nFINI\n");
    assert!(refused["errors"][0]["code"].is_string(), "{refused}");
}

#[test]
fn a_request_to_post_is_watched_and_stopped() {
    let request = json!({ "do": "post", "ready": "fanuc-mill", "cl": CL });
    let watch = filpost_wasm::Watch::default();
    assert!(watch.share() < f64::EPSILON);
    let posted = filpost_wasm::answer_watched(request.clone(), &watch);
    assert!(posted["nc"].is_string() && watch.share() > 1.0 - f64::EPSILON, "{}", watch.share());
    watch.stop();
    let stopped = filpost_wasm::answer_watched(request, &watch);
    assert_eq!((&stopped["errors"][0]["code"], &stopped["nc"]), (&json!("E0711"), &Value::Null));
}

#[test]
fn an_outline_tells_tools_and_operations_sections_and_macros() {
    let outline = |language: &str, text: &str| {
        ask(json!({ "do": "outline", "language": language, "name": "a", "text": text }))
    };
    let cl = outline("cl", "UNITS / MM\nLOADTL / 1\nCYCLE / DRILL, DEPTH, 5\nLOADTL / 2\nFINI\n");
    assert_eq!((&cl[0]["name"], &cl[0]["line"]), (&json!("LOADTL / 1"), &json!(1)));
    assert_eq!(cl[0]["children"][0]["line"], 2);
    assert_eq!(cl[1]["line"], 3);
    let fil = outline("fil", "XX=1\nCIMFIL/ON,COOLNT\nCIMFIL/OFF\nMM=MACRO/AA\nTERMAC\nFINI\n");
    let names: Vec<_> =
        fil.as_array().expect("a list").iter().map(|entry| &entry["name"]).collect();
    assert!(names.contains(&&json!("MM")) && !names.contains(&&json!("XX")), "{names:?}");
}

#[test]
fn names_are_found_and_get_another_one() {
    let text = "FIRST = 1\nCIMFIL/ON,COOLNT\n  XX = FIRST\nCIMFIL/OFF\nFINI\n";
    let at = |what: &str, new: Value| {
        ask(json!({
            "do": what, "language": "fil", "name": "post.fil", "text": text, "line": 2,
            "character": 8, "new": new,
        }))
    };
    let defined = at("definition", Value::Null);
    assert_eq!((&defined[0]["file"], &defined[0]["range"][0]), (&json!("post.fil"), &json!(0)));
    assert_eq!(at("references", Value::Null).as_array().map(Vec::len), Some(2));
    let renamed = at("rename", json!("STARTED"));
    assert_eq!(renamed["edits"].as_array().map(Vec::len), Some(2), "{renamed}");
    assert!(at("rename", json!("1X"))["why"].is_string());
    let call = ask(json!({
        "do": "signature", "language": "fil", "name": "post.fil", "text": "XX = SQRTF(", "character": 11,
    }));
    assert!(call["label"].as_str().is_some_and(|label| label.starts_with("SQRTF(")), "{call}");
    let format = |text: &str| {
        ask(json!({ "do": "format", "language": "fil", "name": "post.fil", "text": text }))
    };
    assert!(format("CIMFIL/ON,COOLNT\nXX=1\nCIMFIL/OFF\nFINI\n")["text"].is_string());
    assert!(format("IF (\n")["why"].is_string());
}

#[test]
fn each_word_of_a_block_has_what_is_behind_it() {
    let cl = "UNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
    let fil = "CIMFIL/ON,LOADTL\nPOSTN/OUT,M,77\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    let request = json!({
        "do": "post", "ready": "fanuc-mill", "cl": cl, "fil": [{ "name": "a.fil", "text": fil }],
    });
    let nc = ask(request.clone())["nc"].as_str().unwrap().to_string();
    let behind = |text: &str| {
        let mut request = request.clone();
        request["do"] = json!("behind");
        request["nc_line"] = json!(nc.lines().position(|line| line.contains(text)).unwrap() + 1);
        let answer = ask(request);
        answer["words"].as_array().unwrap_or_else(|| panic!("{answer}")).clone()
    };
    let words = behind("X1.");
    let of = |text: &str| words.iter().find(|word| word["text"] == text).unwrap();
    assert_eq!((&of("X1.")["line"], &of("X1.")["word"]), (&json!(4), &json!(6)));
    assert_eq!((&of("F200.")["line"], &of("F200.")["fil"]), (&json!(3), &json!([])));
    let of_script = behind("M77");
    assert_eq!(of_script.last().unwrap()["fil"], json!([["a.fil", 2]]));
}
