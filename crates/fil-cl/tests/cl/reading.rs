//! The grammar of CL text, statement by statement.

use fil_cl::record::{kind, motion};
use fil_cl::{ClDialect, Options, Reader, Record, Vocabulary, Word, WordView, words};

fn read_as(text: &str, dialect: Option<ClDialect>) -> (Vec<Record>, Vocabulary) {
    let mut vocab = Vocabulary::new();
    let options = Options { dialect, ..Options::default() };
    let mut reader = Reader::new(text.as_bytes(), "test.ncl", options);
    let (mut records, mut record) = (Vec::new(), Record::default());
    while reader.read(&mut vocab, &mut record).unwrap_or_else(|diag| panic!("{diag}")) {
        records.push(record.clone());
    }
    (records, vocab)
}

fn read(text: &str) -> (Vec<Record>, Vocabulary) {
    read_as(text, None)
}

fn values(record: &Record, vocab: &Vocabulary) -> Vec<Option<f64>> {
    (1..=record.len()).map(|n| record.value(n, vocab)).collect()
}

#[test]
fn thread_words_have_the_numbers_the_paper_uses() {
    let (records, vocab) = read(
        "THREAD / AUTO, 20.000000, 0.000000, 2.000000, TO, 19.000000, 0.000000, -30.000000,$\n \
         TPI, 1.500000, DEEP, 0.300000, LAST, 2.000000, TYPE, 0.000000, 0.920000, 29.000000,$\n \
         IPM, 1.500000, FEDTO, 4.000000, 5.000000, TIMES, 2.000000, OFSETL, 1.000000, 0.0500\n",
    );
    let record = &records[0];
    let at = |n| record.value(n, &vocab).unwrap();
    assert_eq!((at(2), at(3)), (2000.0, 1036.0));
    assert_eq!(at(4), vocab.code(words::AUTO));
    assert_eq!([at(5), at(7), at(9), at(11)], [20.0, 2.0, 19.0, -30.0]);
    assert_eq!([at(13), at(15), at(20), at(21), at(25)], [1.5, 0.3, 0.92, 29.0, 4.0]);
}

#[test]
fn op_thread_words_have_the_numbers_the_paper_uses() {
    let (records, vocab) = read(
        "OP / THREAD, TURN, DEPTH, 1.200000, TPI, 3.000000, MULTRD, 2.000000, CUTS, 6.000000,$\n \
         FINCUT, 1.000000, CUTANG, 30.000000\n",
    );
    let record = &records[0];
    assert_eq!(record.major, words::OP);
    assert_eq!(record.data[0], Word::Minor(words::THREAD));
    assert_eq!(record.data[1], Word::Minor(words::TURN));
    let at = |n| record.value(n, &vocab).unwrap();
    assert_eq!([at(7), at(9), at(11), at(13)], [1.2, 3.0, 2.0, 6.0]);
    assert_eq!(record.number_after(words::CUTANG), Some(30.0));
    assert_eq!(record.find_minor(4, words::TPI), Some(8));
    assert_eq!(record.find_minor(9, words::TPI), None);
}

#[test]
fn a_motion_record_has_its_point_in_words_6_to_8() {
    let (records, vocab) = read("GOTO / 1.0, -2.5, 3.0\nFROM/4,5,6,0,0,1\nGODLTA/-7.5\n");
    assert_eq!((records[0].kind, records[0].sub), (kind::MOTION, motion::GOTO));
    assert_eq!(
        values(&records[0], &vocab),
        [Some(1.0), Some(5000.0), Some(5.0), None, None, Some(1.0), Some(-2.5), Some(3.0)]
    );
    assert_eq!(records[0].class(4), 0);
    assert_eq!((records[1].sub, records[1].axis()), (motion::FROM, Some([0.0, 0.0, 1.0])));
    assert_eq!((records[2].sub, records[2].value(6, &vocab)), (motion::GODLTA, Some(-7.5)));
    assert_eq!(records[2].point(), None);
}

#[test]
fn a_circle_is_in_canonical_form() {
    let (records, vocab) = read(
        "CIRCLE / 1.0, 2.0, -1.5,  $\n0.0000000000, 0.0000000000, -1.0000000000,  1.5000000000\n\
         CIRCLE/1,2,3,4\nCIRCLE/1,2,3,0,1,0\nCIRCLE/1,2,3,0,0,1,4,COUNTERCLOCKWISE\n",
    );
    let words = values(&records[0], &vocab);
    assert_eq!(words[1..6], [3000.0, 4.0, 0.0, 4.0, 7.0].map(Some));
    assert_eq!(words[6..8], [None, None]);
    assert_eq!(words[8..], [1.0, 2.0, -1.5, 0.0, 0.0, -1.0, 1.5].map(Some));
    let circle = records[1].circle().unwrap();
    assert_eq!((circle.axis, circle.radius), ([0.0, 0.0, 1.0], Some(4.0)));
    let circle = records[2].circle().unwrap();
    assert_eq!((circle.axis, circle.radius), ([0.0, 1.0, 0.0], None));
    assert!(records[3].has(words::COUNTERCLOCKWISE) && records[3].len() == 16);
}

#[test]
fn types_of_the_other_statements() {
    let (records, _) = read("UNITS / MM\nMULTAX / ON\nTLAXIS/0,0,1\nCUTTER/10,1\nFINI \nRAPID/\n");
    let types: Vec<_> = records.iter().map(|r| (r.kind, r.sub)).collect();
    assert_eq!(types, [(2000, 0), (9000, 2), (9000, 1), (6000, 6), (14000, 0), (2000, 0)]);
}

#[test]
fn pseudo_comments_are_data_also_when_continued() {
    let (records, vocab) = read(
        "$$*          Pro/CLfile  Version 8.0 - 8.0.3.0\n$$ a comment\n\
         $$-> CSYS / 1.0, 0.0, 0.0, 0.0,  $\n            0.0, 1.0, 0.0, 0.0,  $\n\
         \x20           0.0, 0.0, 1.0, 5.5\n$$-> MFGNO / my part 7/8\n$$-> END / \n",
    );
    assert_eq!(records.len(), 3);
    assert!(records.iter().all(|record| record.kind == kind::PSEUDO));
    assert_eq!((records[0].major, records[0].line), (words::CSYS, 3));
    assert_eq!(records[0].value(15, &vocab), Some(5.5));
    assert_eq!(records[1].word(4, &vocab), Some(WordView::Text("my part 7/8")));
    assert_eq!((records[2].major, records[2].len()), (words::END, 3));
}

#[test]
fn text_statements_keep_their_text() {
    let (records, _) = read(
        "PARTNO / MFG0004\nPARTNO test      \nPPRINT/ COST $$ 5, SEE A/B\nINSERT G4 X1/2\n\
         TOOL PATH/9_K,TOOL,FACE MILL\ninsert /  two blanks\nPPRINT\nPPRINT / one $\nINSERT G1 $$\nINSERT //M30\n\
         INSERT / /M30\nINSERT/M30\n",
    );
    let texts: Vec<_> = records.iter().map(|record| record.text.as_str()).collect();
    assert_eq!(
        texts,
        [
            "MFG0004",
            "test",
            "COST $$ 5, SEE A/B",
            "G4 X1/2",
            "9_K,TOOL,FACE MILL",
            " two blanks",
            "",
            "one $",
            "G1 $$",
            "/M30",
            "/M30",
            "M30",
        ]
    );
    assert_eq!(records[4].major, words::TOOL_PATH);
    assert!(records.iter().all(|record| record.class(4) == 3 && record.len() == 4));
}

#[test]
fn a_text_that_is_not_utf8_goes_through_the_hook() {
    let mut vocab = Vocabulary::new();
    let mut record = Record::default();
    let input: &[u8] = b"PPRINT / \xCF\xF0\nPPRINT / \xD0\x9F\nMACHIN / \xEC,1\n";
    let decode = |bytes: &[u8]| format!("<{}>", bytes.len());
    let mut reader = Reader::new(input, "t", Options { decode, ..Options::default() });
    reader.read(&mut vocab, &mut record).unwrap();
    assert_eq!(record.text, "<2>");
    reader.read(&mut vocab, &mut record).unwrap();
    assert_eq!(record.text, "П");
    let mut reader = Reader::new(input, "t", Options::default());
    for text in ["Ïð", "П"] {
        reader.read(&mut vocab, &mut record).unwrap();
        assert_eq!(record.text, text);
    }
    reader.read(&mut vocab, &mut record).unwrap();
    assert_eq!(
        record.word(4, &vocab),
        Some(WordView::Word { name: "Ì", code: vocab.code(vocab.find("ì").unwrap()) })
    );
}

#[test]
fn layout_and_case_mean_nothing() {
    let creo =
        read("\u{feff}FEDRAT / 400.000000,  MMPM\r\nGOTO / 1.0, 2.0, 3.0\r\nRAPID \r\n\x1a").0;
    let bare = read("fedrat/4.E+2,mmpm $$ slow\n\n \t\ngo to /1.D0,+2,3.\nrapid/").0;
    let strip = |records: Vec<Record>| -> Vec<Record> {
        records.into_iter().map(|record| Record { line: 0, ..record }).collect()
    };
    assert_eq!(strip(creo), strip(bare));
}

#[test]
fn continuation_skips_comments_and_blank_lines() {
    let (records, _) =
        read("CYCLE / DEEP, STEP,  $ $$ first\n$$ second\n\n 1.5, CLEAR,$\n2\nRAPID\n");
    assert_eq!(records.len(), 2);
    assert_eq!(records[0].number_after(words::STEP), Some(1.5));
    assert_eq!(records[0].number_after(words::CLEAR), Some(2.0));
    assert_eq!(records[1].line, 6);
}

#[test]
fn creo_packs_points() {
    let creo = |text: &str| read_as(text, Some(ClDialect::Creo)).0;
    let records = creo("GOTO/0,0,0\nGOTO/1,2,3,4,5,6,7,8,9\nGOTO/1,2,3,0,0.6,0.8\n");
    let points: Vec<_> = records.iter().map(|r| (r.number, r.line, r.point().unwrap())).collect();
    assert_eq!(
        points,
        [
            (1, 1, [0.0, 0.0, 0.0]),
            (2, 2, [1.0, 2.0, 3.0]),
            (3, 2, [4.0, 5.0, 6.0]),
            (4, 2, [7.0, 8.0, 9.0]),
            (5, 3, [1.0, 2.0, 3.0]),
        ]
    );
    assert_eq!(records[4].axis(), Some([0.0, 0.6, 0.8]));
    let records = creo("MULTAX/ON\nGOTO/1,2,3,0,0,1,4,5,6,0,1,0\nGOTO/7,8,9\n");
    assert_eq!(records.len(), 4);
    assert_eq!(records[2].axis(), Some([0.0, 1.0, 0.0]));
    assert_eq!(records[3].axis(), None);
}

#[test]
fn a_tool_axis_may_be_rounded() {
    for axis in ["0,0.577,0.8165", "0.577,0.577,0.578", "0.0000000,0.6000001,0.7999999"] {
        let (records, _) = read(&format!("GOTO/1,2,3,{axis}\nFROM/1,2,3,{axis}\n"));
        assert!(records.iter().all(|record| record.axis().is_some()), "{axis}");
    }
}

#[test]
fn a_tool_axis_that_comes_again_is_the_same() {
    let text = "MULTAX/ON\nGOTO/1,2,3, 0,0,1\nGOTO/4,5,6, 0,0,1\nGOTO/7,8,9, 0,0,-1\n\
                GOTO/7,8,9, 0,0,1.0\nGOTO/1,2,3, 0,0,1 $$ up\nGOTO/1,2,3, 0,1,0\nGOTO/4,5,6, 0,0,1\n";
    let (records, vocab) = read(text);
    let axes = records[1..].iter().map(|record| {
        (9..=11).map(|number| record.value(number, &vocab).unwrap()).collect::<Vec<_>>()
    });
    let up = [0.0, 0.0, 1.0];
    assert_eq!(
        axes.collect::<Vec<_>>(),
        [up, up, [0.0, 0.0, -1.0], up, up, [0.0, 1.0, 0.0], up].map(Vec::from)
    );
}

#[test]
fn nx_keeps_the_axis_and_turns_circles() {
    let text = "TOOL PATH/A,TOOL,B\nGOTO/1,2,3,0,0,1\nGOTO/4,5,6\n\
                CIRCLE/0,0,0,0,0,-1,18,0.06,0.5,40,1,TIMES,2\nEND-OF-PATH\n";
    let (records, vocab) = read(text);
    assert_eq!(records[2].axis(), Some([0.0, 0.0, 1.0]));
    assert_eq!(records[3].circle().unwrap().axis, [0.0, 0.0, 1.0]);
    assert_eq!(records[3].number_after(words::TIMES), Some(2.0));
    assert_eq!(vocab.name(records[4].major), "END-OF-PATH");
}

#[test]
fn ncl_keeps_the_axis_while_multax_is_on() {
    let (records, _) = read(
        "REMARK NCLCAM\nMULTAX/ON\nGOTO  / 1, 2, 3, 0, 1, 0\nGOTO/4,5,6\nMULTAX/OFF\nGOTO/7,8,9\n",
    );
    assert_eq!(records[3].axis(), Some([0.0, 1.0, 0.0]));
    assert_eq!(records[5].axis(), None);
}

#[test]
fn unknown_statements_pass_through() {
    let (records, vocab) =
        read("MOVE_ATTRIB/LEADIN,1.5,(a b)\nXYZZY\nCYCLE/EMBOSL,1.,,2\nMACHIN/3AX-7,1\n");
    assert_eq!(vocab.name(records[0].major), "MOVE_ATTRIB");
    assert_eq!(records[0].word(6, &vocab), Some(WordView::Text("(a b)")));
    assert_eq!(records[1].len(), 3);
    let Some(Word::Minor(id)) = records[2].data_word(4) else { panic!("a minor word is due") };
    assert_eq!((vocab.name(id), vocab.is_public(id)), ("EMBOSL", false));
    assert_eq!(records[2].data_word(6), Some(Word::Empty));
    assert!(matches!(records[3].data_word(4), Some(Word::Minor(_))));
}

#[test]
fn any_pseudo_comment_is_read() {
    let (records, vocab) =
        read("$$-> see the drawing\n$$-> NURBS / 1, a=b\n$$->\n$$-> GO TO / 5\n");
    let keys: Vec<_> = records.iter().map(|record| vocab.name(record.major)).collect();
    assert_eq!(keys, ["SEE THE DRAWING", "NURBS", "GOTO"]);
    assert!(records.iter().all(|record| record.kind == kind::PSEUDO));
}

#[test]
fn words_can_be_edited() {
    let (records, vocab) = read("CYCLE/DRILL,DEPTH,5\n");
    let mut record = records[0].clone();
    assert!(record.set(6, Word::Number(7.0)) && !record.set(7, Word::Empty));
    assert!(record.insert(7, Word::Minor(words::CLEAR)) && !record.insert(9, Word::Empty));
    assert!(record.delete(4) && !record.delete(3) && !record.delete(7));
    assert!(record.resize(8) && !record.resize(2) && !record.resize(usize::MAX));
    assert_eq!(record.data[..2], [Word::Minor(words::DEPTH), Word::Number(7.0)]);
    assert_eq!((record.len(), record.class(6), record.class(7), record.class(9)), (8, 2, 0, 0));
    assert_eq!(record.value(3, &vocab), Some(1054.0));
    let word = record.store_text("abc");
    assert!(record.set(4, word));
    assert_eq!((record.text_of(word), record.class(4)), ("abc", 3));
}

#[test]
fn a_script_makes_the_records_a_file_makes() {
    let (records, _) = read("GOTO/1,2,3,0,0,1\nCIRCLE/1,2,3,0,0,1,5\nPPRINT/HI\nRAPID\n");
    let same = |made: Record, read: &Record| {
        assert_eq!(Record { number: read.number, line: read.line, ..made }, *read);
    };
    same(Record::goto([1.0, 2.0, 3.0], Some([0.0, 0.0, 1.0])), &records[0]);
    same(Record::arc(records[1].circle().unwrap()), &records[1]);
    same(Record::text_command(words::PPRINT, "HI"), &records[2]);
    same(Record::command(words::RAPID), &records[3]);
    let items = [1.0, 2.0, 3.0, 0.0, 0.0, 1.0].map(Word::Number).to_vec();
    same(Record::statement(words::GOTO, items, String::new()).unwrap(), &records[0]);
    let wrong = Record::statement(words::GOTO, vec![Word::Minor(words::ON)], String::new());
    assert_eq!(wrong.unwrap_err().item, 0);
}

/// Names of operations are no vocabulary: a file may have any number of them, and the words
/// known do not grow with it.
#[test]
fn any_number_of_names() {
    let number = 60_000;
    for (head, word) in [
        ("$$*CATIA0\n", "OP_NAME/Drilling.#\n"),
        ("TOOL PATH/A,TOOL,B\n", "PAINT/N#\n"),
        ("", "$$-> FEATNO / N#\n"),
        ("", "SITE_WORD/N#,4\n"),
    ] {
        let names: String = (0..number).map(|n| word.replace('#', &n.to_string())).collect();
        let text = format!("{head}{names}GOTO/1,2,3\nFINI\n");
        let mut reader = Reader::new(text.as_bytes(), "x", Options::default());
        let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
        let mut records = 0;
        while reader.read(&mut vocab, &mut record).unwrap_or_else(|diag| panic!("{diag}")) {
            records += 1;
        }
        assert!(records >= number + 2 && vocab.len() < 21_000, "{word}: {records}");
    }
    // A word that a script knows stays a word.
    let text: String = (0..number).map(|n| format!("SITE_WORD/N{n}\n")).collect();
    let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
    let last = vocab.intern(&format!("N{}", number - 1));
    let mut reader = Reader::new(text.as_bytes(), "x", Options::default());
    while reader.read(&mut vocab, &mut record).unwrap() {}
    assert!(record.has(last));
    // In a statement for the post there is no text.
    let text: String = (0..number).map(|n| format!("COOLNT/N{n}\n")).collect();
    let mut reader = Reader::new(text.as_bytes(), "x", Options::default());
    let refused = loop {
        match reader.read(&mut vocab, &mut record) {
            Ok(more) => assert!(more, "to the end"),
            Err(diag) => break diag,
        }
    };
    assert_eq!(refused.code.number, 411);
}
