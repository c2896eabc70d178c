//! Properties over generated input.

use std::io::Cursor;

use fil_cl::{Circle, ClDialect, Options, Reader, Record, Vocabulary, Word, WordId, Writer, words};
use proptest::prelude::*;

fn read_all(text: &[u8], vocab: &mut Vocabulary) -> Result<Vec<Record>, String> {
    read_as(text, vocab, Options::default())
}

fn read_as(text: &[u8], vocab: &mut Vocabulary, options: Options) -> Result<Vec<Record>, String> {
    let mut reader = Reader::new(text, "p", options);
    let (mut records, mut record) = (Vec::new(), Record::default());
    while reader.read(vocab, &mut record).map_err(|diag| diag.to_string())? {
        records.push(Record { number: 0, line: 0, ..record.clone() });
    }
    Ok(records)
}

fn number() -> impl Strategy<Value = f64> {
    let finite = any::<f64>().prop_filter("finite", |value| value.is_finite());
    prop_oneof![finite, (-1e6..1e6f64), (-10_000i32..10_000).prop_map(f64::from)]
        .prop_map(|value| value + 0.0)
}

fn point() -> impl Strategy<Value = [f64; 3]> {
    [number(), number(), number()]
}

fn axis() -> impl Strategy<Value = [f64; 3]> {
    (0.0..360.0f64, -90.0..90.0f64).prop_map(|(turn, lift)| {
        let (turn, lift) = (turn.to_radians(), lift.to_radians());
        [libm::cos(turn) * libm::cos(lift), libm::sin(turn) * libm::cos(lift), libm::sin(lift)]
            .map(|part| part + 0.0)
    })
}

const MAJORS: [WordId; 6] =
    [words::CYCLE, words::SPINDL, words::FEDRAT, words::LOADTL, words::OP, words::CUTTER];
const MINORS: [WordId; 5] =
    [words::DEEP, words::DEPTH, words::CLEAR, words::FIRST_PECK, words::MMPM];

fn item() -> impl Strategy<Value = Word> {
    prop_oneof![
        4 => number().prop_map(Word::Number),
        3 => prop::sample::select(&MINORS[..]).prop_map(Word::Minor),
        1 => Just(Word::Empty),
    ]
}

fn command() -> impl Strategy<Value = Record> {
    (prop::sample::select(&MAJORS[..]), prop::collection::vec(item(), 0..20))
        .prop_filter("an empty slot at the end has no text form", |(_, items)| {
            items.last().is_some_and(|last| *last != Word::Empty)
        })
        .prop_map(|(major, items)| Record::statement(major, items, String::new()).unwrap())
}

fn circle() -> impl Strategy<Value = Record> {
    (point(), axis(), prop::option::of(0.1..1e4f64))
        .prop_map(|(center, axis, radius)| Record::arc(Circle { center, axis, radius }))
}

fn text() -> impl Strategy<Value = Record> {
    let texts =
        "[ -~а-яÄ]{0,60}".prop_filter("a line must hold it", |text| text.trim_end() == text);
    (prop::sample::select(&[words::PPRINT, words::PARTNO, words::INSERT][..]), texts)
        .prop_map(|(major, text)| Record::text_command(major, &text))
}

/// A pseudo-comment; it may hold texts where a post command may not.
fn pseudo() -> impl Strategy<Value = Record> {
    let text = "[(=][ -#%-+.-~а-я]{0,20}[)=]";
    (command(), prop::option::of(text)).prop_map(|(mut record, text)| {
        if let Some(text) = text {
            let word = record.store_text(&text);
            record.data.push(word);
        }
        Record { kind: fil_cl::record::kind::PSEUDO, sub: 0, ..record }
    })
}

fn dialect() -> impl Strategy<Value = Option<ClDialect>> {
    prop::option::of(prop::sample::select(ClDialect::ALL))
}

/// Pieces of statements, some of them so long that CATIA would cut their line.
fn pieces() -> impl Strategy<Value = Vec<&'static str>> {
    const PIECES: &[&str] = &[
        "GOTO",
        "CIRCLE",
        "MULTAX",
        "PPRINT",
        "TOOL PATH",
        "$$-> ",
        "$$",
        "$",
        "/",
        ",",
        " ",
        "\n",
        "\r\n",
        "1",
        "-2.5",
        "1e5",
        ".",
        "ON",
        "12.3.4",
        "\u{444}",
        "=",
        "(",
        "1STPECK",
        "CHANNEL",
        "$$*CATIA0\n",
        "PAINT/A\n",
        "GOTO/0,0,1,0,0,1\n",
        "CIRCLE/0,0,0,0,0,1,5\n",
        "RAPID\n",
        "PPRINT/xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx$\n",
        "$$ xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx$\n",
    ];
    prop::collection::vec(prop::sample::select(PIECES), 0..60)
}

fn records() -> impl Strategy<Value = Vec<Record>> {
    let record = prop_oneof![
        3 => (point(), prop::option::of(axis())).prop_map(|(p, a)| Record::goto(p, a)),
        2 => command(),
        1 => circle(),
        1 => text(),
        1 => pseudo(),
    ];
    prop::collection::vec(record, 1..30)
}

proptest! {
    #[test]
    fn written_records_read_back_the_same(records in records()) {
        let mut vocab = Vocabulary::new();
        let mut writer = Writer::new(Vec::new());
        for record in &records {
            writer.write(record, &vocab).unwrap();
        }
        let output = writer.into_inner();
        let text = String::from_utf8(output.clone()).unwrap();
        // Circles with and without a radius, and nothing filled in.
        let dialect = Some(ClDialect::Generic);
        let options = Options { dialect, raw: true, ..Options::default() };
        let again = read_as(&output, &mut vocab, options);
        prop_assert_eq!(again, Ok(records), "{}", text);
    }

    #[test]
    fn any_bytes_are_read_or_refused(
        bytes in prop::collection::vec(any::<u8>(), 0..2000),
        dialect in dialect(),
    ) {
        let options = Options { dialect, ..Options::default() };
        let _ = read_as(&bytes, &mut Vocabulary::new(), options);
    }

    #[test]
    fn any_text_of_cl_pieces_is_read_or_refused(pieces in pieces(), dialect in dialect()) {
        let options = Options { dialect, ..Options::default() };
        let _ = read_as(pieces.concat().as_bytes(), &mut Vocabulary::new(), options);
    }

    /// The line ends of DOS give the same records.
    #[test]
    fn line_ends_change_nothing(pieces in pieces(), dialect in dialect()) {
        let options = Options { dialect, ..Options::default() };
        let plain = pieces.concat().replace('\r', "") + "\n";
        let dos = plain.replace('\n', "\r\n");
        let read = |text: &str| read_as(text.as_bytes(), &mut Vocabulary::new(), options).ok();
        prop_assert_eq!(read(&plain), read(&dos));
    }

    /// A statement with a text is a record of its own, and the statements after it are read.
    #[test]
    fn a_text_takes_nothing_with_it(text in "[ -~]{0,60}", dialect in dialect()) {
        let options = Options { dialect, raw: true, ..Options::default() };
        let cl = format!("INSERT / {text}\nGOTO / 1, 2, 3\n");
        let records = read_as(cl.as_bytes(), &mut Vocabulary::new(), options).unwrap();
        prop_assert_eq!(records.len(), 2);
        prop_assert_eq!(&records[0].text, text.trim_end());
    }

    /// All points of all GOTO statements come out, or the text is refused.
    #[test]
    fn no_value_of_a_goto_is_lost(
        values in prop::collection::vec(prop_oneof![Just("0"), Just("1"), Just("-0.5")], 1..20),
        multax in any::<bool>(),
        dialect in dialect(),
    ) {
        let options = Options { dialect, ..Options::default() };
        let mode = if multax { "MULTAX/ON\n" } else { "" };
        let cl = format!("{mode}GOTO/{}\n", values.join(","));
        let Ok(records) = read_as(cl.as_bytes(), &mut Vocabulary::new(), options) else {
            return Ok(());
        };
        let found: Vec<Word> = records
            .iter()
            .filter(|record| record.kind == fil_cl::record::kind::MOTION)
            .flat_map(|record| record.data[2..].to_vec())
            .collect();
        let mut expected: Vec<Word> =
            values.iter().map(|value| Word::Number(value.parse().unwrap())).collect();
        // A tool axis of no length is none where the slicer writes it.
        if dialect == Some(ClDialect::OrnlSlicer) && expected.get(3..) == Some(&[Word::Number(0.0); 3]) {
            expected.truncate(3);
        }
        if multax && found.len() == 6 && expected.len() == 3 {
            expected.extend([0.0, 0.0, 1.0].map(Word::Number));
        }
        prop_assert_eq!(found, expected);
    }

    /// The short way for GOTO and the long way make the same records.
    #[test]
    fn both_ways_agree(values in prop::collection::vec("-?[0-9]{1,6}\\.[0-9]{0,10}", 1..8)) {
        let plain = format!("MULTAX/ON\nGOTO / {}\n", values.join(", "));
        let continued = format!("MULTAX/ON\nGOTO / $\n{}\n", values.join(", "));
        let read = |text: &str| read_all(text.as_bytes(), &mut Vocabulary::new());
        prop_assert_eq!(read(&plain).ok(), read(&continued).ok());
    }

    #[test]
    fn seeking_gives_the_record_of_a_straight_run(
        kinds in prop::collection::vec(0..5usize, 12_000..14_000),
        wanted in prop::collection::vec(1..12_000u32, 1..8),
    ) {
        // The axis of the second GOTO hangs on the records before it.
        let statements =
            ["GOTO/1,2,3,0,1,0\n", "RAPID\n", "MULTAX/ON\n", "GOTO/1,2,3\n", "MULTAX/OFF\n"];
        let lines = kinds.into_iter().map(|kind| statements[kind]);
        let text: String = std::iter::once("REMARK NCLCAM\n").chain(lines).collect();
        let (mut vocab, mut record) = (Vocabulary::new(), Record::default());
        let mut straight = Vec::new();
        let mut reader = Reader::new(text.as_bytes(), "s", Options::default());
        while reader.read(&mut vocab, &mut record).unwrap() {
            straight.push(record.clone());
        }
        let mut reader = Reader::seekable(Cursor::new(text.as_str()), "s", Options::default());
        for number in wanted {
            reader.seek_record(number).unwrap();
            prop_assert!(reader.read(&mut vocab, &mut record).unwrap());
            prop_assert_eq!(&record, &straight[number as usize - 1]);
            prop_assert_eq!(reader.record_number(), number);
        }
    }
}
