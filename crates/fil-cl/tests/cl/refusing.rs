//! Every code of the crate, with the place it points to.

use std::io::{self, Cursor, Read};

use fil_cl::{ClCode, Options, Reader, Record, Vocabulary, Word, Writer, words};
use fil_diag::{Code, Diag};

/// Reads to the first error.
fn refuse(input: &[u8]) -> Diag {
    let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
    let mut reader = Reader::new(input, "bad.ncl", Options::default());
    loop {
        match reader.read(&mut vocab, &mut record) {
            Ok(true) => {}
            Ok(false) => panic!("nothing was refused"),
            Err(diag) => {
                let again = reader.read(&mut vocab, &mut record).expect_err("an error stays");
                assert_eq!(again.message, diag.message);
                return *diag;
            }
        }
    }
}

/// Checks code, line, column and the text marked.
fn check(input: &str, code: ClCode, line: u32, column: usize, marked: &str) {
    let diag = refuse(input.as_bytes());
    let code: &Code = code.into();
    assert_eq!(diag.code, code, "{input:?}: {diag}");
    let place = &diag.spans[0];
    assert_eq!((place.line, place.column()), (line, column), "{input:?}: {diag}");
    assert_eq!(&place.excerpt[place.span.clone()], marked, "{input:?}");
}

#[test]
fn bad_numbers() {
    check("RAPID\nGOTO / 1.0, 12.3.4, 3.0\n", ClCode::BadNumber, 2, 13, "12.3.4");
    check("GOTO/1.0X,2,3\n", ClCode::BadNumber, 1, 6, "1.0X");
    check("SPINDL / RPM, 10O0, CLW\n", ClCode::BadNumber, 1, 15, "10O0");
    check("FEDRAT/1e999,MMPM\n", ClCode::BadNumber, 1, 8, "1e999");
    check("FEDRAT/- 5,MMPM\n", ClCode::BadNumber, 1, 8, "- 5");
    check("CYCLE/DEEP,  $\n   STEP, 1..5\n", ClCode::BadNumber, 2, 10, "1..5");
}

#[test]
fn bad_words() {
    check("SPINDL / (RPM), 5\n", ClCode::BadWord, 1, 10, "(RPM)");
    check("CYCLE/DEEP STEP,5\n", ClCode::BadWord, 1, 7, "DEEP STEP");
    check("12 / 5\n", ClCode::BadWord, 1, 1, "12");
    check("this is prose\n", ClCode::BadWord, 1, 1, "this is prose");
    check("PTE   =PT/TE\n", ClCode::BadWord, 1, 1, "PTE   =PT");
    check("/ 1, 2\n", ClCode::BadWord, 1, 1, "");
    check("INSERT /M30\n", ClCode::BadWord, 1, 9, "M30");
    check("PPRINT,X/5\n", ClCode::BadWord, 1, 1, "PPRINT,X");
}

#[test]
fn bad_points() {
    check("GOTO / 1.0, 2.0\n", ClCode::BadPoint, 1, 13, "2.0");
    check("GOTO / 1.0,, 3.0\n", ClCode::BadPoint, 1, 12, "");
    check("GOTO / 1.0, NAN, 3.0\n", ClCode::BadPoint, 1, 13, "NAN");
    check("GOTO/\n", ClCode::BadPoint, 1, 1, "GOTO/");
    check("MULTAX/ON\nGOTO/1,2,3,4,5,6,7,8,9\n", ClCode::BadPoint, 2, 22, "9");
    check("FROM/1,2,3,4\n", ClCode::BadPoint, 1, 12, "4");
    check("CIRCLE/1,2,3,0,1\n", ClCode::BadPoint, 1, 16, "1");
}

#[test]
fn motion_without_points() {
    check("GOLFT/1,0,0\n", ClCode::UncomputedMotion, 1, 1, "GOLFT");
    let arc = "TLON,GOFWD/ (CIRCLE/ 0,0,0,$\n 5),ON,(LINE/ 0,0,0,$\n 1,1,1)\n";
    check(arc, ClCode::UncomputedMotion, 1, 1, "TLON,GOFWD/ (CIRCLE/ 0,0,0,$");
    check("NURBS/\nKNOT/0,0\n", ClCode::UncomputedMotion, 1, 1, "NURBS");
}

#[test]
fn cut_off_statements() {
    check("RAPID\nGOTO / 1.0, 2.0,  $\n", ClCode::OpenContinuation, 2, 19, "$");
    check("GOTO / 1.0, 2.0,$", ClCode::OpenContinuation, 1, 17, "$");
    check("GOTO / 1.0,$\n$$-> END / \n", ClCode::OpenContinuation, 1, 12, "$");
    check("$$-> CSYS / 1,$\n", ClCode::OpenContinuation, 1, 15, "$");
}

#[test]
fn binary_data() {
    check("RAPID\nGOTO / 1.0, 2\0, 3\n", ClCode::BinaryData, 2, 14, "\0");
    check("PPRINT / A\0\n", ClCode::BinaryData, 1, 11, "\0");
    let wide: Vec<u8> = "GOTO/1,2,3\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    assert_eq!(refuse(&wide).code.number, 402);
    assert_eq!(refuse(&vec![0; 3 << 20]).code.number, 402);
}

#[test]
fn long_statements() {
    let line = format!("RAPID\nPPRINT / {}", "x".repeat(2 << 20));
    let diag = refuse(line.as_bytes());
    assert_eq!((diag.code.number, diag.spans[0].line), (403, 2));
    assert!(diag.spans[0].excerpt.len() < 1000);
    let continued = "CYCLE / $\n".repeat(200_000);
    assert_eq!(refuse(continued.as_bytes()).code.number, 403);
}

#[test]
fn too_many_words() {
    let text: String = (0..60_000).map(|n| format!("W{n}/1\n")).collect();
    let diag = refuse(text.as_bytes());
    assert_eq!(diag.code.number, 411);
    assert!(diag.spans[0].line > 40_000);
}

#[test]
fn noise_is_refused_before_much_of_it_is_read() {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut noise = |mask: u8| -> Vec<u8> {
        let next = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 32) as u8 & mask
        };
        std::iter::repeat_with(next).take(10 << 20).collect()
    };
    for (input, code) in [(noise(0xFF), 402), (noise(0x7F), 402), (vec![b'$'; 10 << 20], 403)] {
        let mut input = Cursor::new(input);
        let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
        let mut reader = Reader::new(&mut input, "noise", Options::default());
        let refused = loop {
            match reader.read(&mut vocab, &mut record) {
                Ok(more) => assert!(more, "noise was taken"),
                Err(diag) => break diag.code.number,
            }
        };
        drop(reader);
        assert_eq!(refused, code);
        let read = input.position();
        assert!(read <= 2 * Options::default().statement_limit as u64, "{read} bytes");
    }
}

#[test]
fn an_input_that_fails() {
    struct Failing;
    impl Read for Failing {
        fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
            Err(io::Error::other("disk on fire"))
        }
    }
    let input = io::Cursor::new("RAPID\n".repeat(4000)).chain(Failing);
    let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
    let mut reader = Reader::new(input, "x.ncl", Options::default());
    let error = loop {
        match reader.read(&mut vocab, &mut record) {
            Ok(more) => assert!(more, "the end was taken for good"),
            Err(error) => break error,
        }
    };
    assert_eq!((error.code.number, error.message.as_str()), (401, "disk on fire"));
    assert_eq!((reader.record_number(), error.spans[0].line), (4000, 4001));
}

#[test]
fn a_stream_does_not_go_back() {
    let mut reader = Reader::new(&b"RAPID\nRAPID\n"[..], "x.ncl", Options::default());
    let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
    reader.read(&mut vocab, &mut record).unwrap();
    reader.read(&mut vocab, &mut record).unwrap();
    let diag = reader.seek_record(1).unwrap_err();
    assert_eq!((diag.code.number, diag.spans[0].line), (409, 2));
}

#[test]
fn records_that_are_not_there() {
    let mut reader = Reader::seekable(Cursor::new("RAPID\nRAPID\n"), "x.ncl", Options::default());
    assert_eq!(reader.seek_record(0).unwrap_err().code.number, 410);
    let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
    reader.seek_record(3).unwrap();
    let diag = reader.read(&mut vocab, &mut record).unwrap_err();
    assert_eq!((diag.code.number, diag.message.as_str()), (410, "record 3 of 2 records"));
    reader.seek_record(2).unwrap();
    assert!(reader.read(&mut vocab, &mut record).unwrap());
    assert_eq!((record.number, record.line), (2, 2));
}

#[test]
fn records_without_a_text_form() {
    let vocab = Vocabulary::new();
    let refused = |record: Record| {
        let diag = Writer::new(Vec::new()).write(&record, &vocab).unwrap_err();
        assert_eq!(diag.code.number, 412);
    };
    let mut record = Record::command(words::CYCLE);
    record.data = vec![Word::Number(f64::NAN)];
    refused(record.clone());
    record.data = vec![Word::Empty];
    refused(record.clone());
    for text in ["(a,b)", "NAME", "1.5", "", " (x)"] {
        let mut record = Record { kind: fil_cl::record::kind::PSEUDO, ..record.clone() };
        record.data = vec![record.store_text(text)];
        refused(record);
    }
    record.data = vec![record.store_text("(a b)")];
    refused(record);
    refused(Record::text_command(words::PPRINT, "two\nlines"));
    refused(Record::command(words::PPRINT));
}

#[test]
fn an_output_that_fails() {
    let mut short = [0u8; 4];
    let mut writer = Writer::new(&mut short[..]);
    let diag = writer.write(&Record::command(words::RAPID), &Vocabulary::new()).unwrap_err();
    assert_eq!(diag.code.number, 413);
}

#[test]
fn numbers_of_the_codes_are_in_order() {
    let numbers: Vec<_> = ClCode::ALL.iter().map(|code| code.number).collect();
    assert!(numbers.is_sorted_by(|one, next| one < next), "{numbers:?}");
    assert!(numbers.iter().all(|number| (401..500).contains(number)), "{numbers:?}");
}

#[test]
fn items_that_are_missing() {
    check("FEDRAT\n", ClCode::MissingItem, 1, 1, "FEDRAT");
    check("RAPID\n  spindl/ \n", ClCode::MissingItem, 2, 1, "  spindl/");
    check("CYCLE / DEEP, DEPTH,\n", ClCode::MissingItem, 1, 20, ",");
    check("SPINDL/RPM, , \nRAPID\n", ClCode::MissingItem, 1, 13, ",");
    check("GOTO/1,2,\n3\n", ClCode::MissingItem, 1, 9, ",");
}

#[test]
fn a_last_line_without_an_end() {
    check("RAPID\nGOTO / 1.0, 2.0, 3.", ClCode::LineCutOff, 2, 18, "3.");
    check("RAPID\nGOTO/1,2,3  ", ClCode::LineCutOff, 2, 10, "3");
    check("FEDRAT/400,MMP", ClCode::LineCutOff, 1, 12, "MMP");
    check("INSERT M3", ClCode::LineCutOff, 1, 8, "M3");
    check("$$-> CUTTER / 3.0", ClCode::LineCutOff, 1, 15, "3.0");
    for whole in ["FINI", "GOTO/1,2,3\nRAPID/", "SPINDL / OFF", "FEDRAT/400,MMPM", "$$-> END / "] {
        let mut reader = Reader::new(whole.as_bytes(), "x", Options::default());
        let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
        while reader.read(&mut vocab, &mut record).unwrap_or_else(|diag| panic!("{diag}")) {}
    }
    // The end sign of DOS says that the text is whole.
    let mut reader = Reader::new(&b"GOTO/1,2,3\x1A\x1A"[..], "x", Options::default());
    assert!(reader.read(&mut Vocabulary::new(), &mut Record::default()).unwrap());
}

#[test]
fn hidden_characters_in_names() {
    check("RAPID\u{A0}\n", ClCode::BadWord, 1, 1, "RAPID\u{A0}");
    check("RAPID\n\u{FEFF}GOTO/1,2,3\n", ClCode::BadWord, 2, 1, "\u{FEFF}GOTO");
    check("FEDRAT/400,\u{A0}MMPM\n", ClCode::BadWord, 1, 12, "\u{A0}MMPM");
    check("SPINDL/\u{200B}ON\n", ClCode::BadWord, 1, 8, "\u{200B}ON");
    // A Cyrillic letter that looks like C, and a Greek one that looks like O.
    check("\u{421}YCLE/DRILL\n", ClCode::BadWord, 1, 1, "\u{421}YCLE");
    check("SPINDL/\u{39F}FF\n", ClCode::BadWord, 1, 8, "\u{39F}FF");
}

#[test]
fn line_ends_that_are_none() {
    check("$$ header\rGOTO/1,2,3\rFINI\r", ClCode::BinaryData, 1, 10, "\r");
    check("RAPID $$ slow\rGOTO/1,2,3\n", ClCode::BinaryData, 1, 14, "\r");
    check("PPRINT / A\rGOTO/1,2,3\n", ClCode::BinaryData, 1, 11, "\r");
    check("GOTO/1,2,$\n$$ c\rRAPID\n3\n", ClCode::BinaryData, 2, 5, "\r");
    check("RAPID\x1A\nGOTO/1,2,3\n", ClCode::BinaryData, 1, 6, "\x1A");
}
