//! Long texts that went to the page or came from it before: later requests and answers name them, or say what is
//! different in them.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use serde_json::{Value, json};

/// Texts that are kept; the page keeps as many.
const MOST: usize = 8;

/// Shortest text of an answer that is named, bytes.
const LONG: usize = 100_000;

/// Longest name of a text, bytes.
const LONGEST_NAME: usize = 64;

/// A request names a text that is no longer kept, or was never sent.
pub(crate) struct Unkept;

/// The texts by name, the newest last.
#[derive(Default)]
pub(crate) struct Texts(Mutex<VecDeque<(String, Arc<str>)>>);

impl Texts {
    /// Puts the texts of a request into their fields. `texts` has for each field `{"kept": NAME}`, or
    /// `{"keep": NAME, "text": …}` for one that is kept from now on; there `of`, `from` and `to` name another text whose
    /// bytes up to `from` and from `to` on stand around `text`.
    ///
    /// # Errors
    /// A text that is not kept: the page sends the request again with whole texts.
    pub fn put_into(&self, request: &mut Value) -> Result<(), Unkept> {
        let Some(fields) = request.as_object_mut() else { return Ok(()) };
        let Some(Value::Object(texts)) = fields.remove("texts") else { return Ok(()) };
        for (field, text) in texts {
            let whole = self.whole(&text).ok_or(Unkept)?;
            fields.insert(field, Value::String(whole.to_string()));
        }
        Ok(())
    }

    fn whole(&self, said: &Value) -> Option<Arc<str>> {
        if let Some(name) = said["kept"].as_str() {
            return self.find(name);
        }
        let name = said["keep"].as_str().filter(|name| name.len() <= LONGEST_NAME)?;
        let text = said["text"].as_str()?;
        let whole: Arc<str> = match said["of"].as_str() {
            None => text.into(),
            Some(of) => {
                let other = self.find(of)?;
                let place = |key: &str| usize::try_from(said[key].as_u64()?).ok();
                let (before, behind) = (other.get(..place("from")?)?, other.get(place("to")?..)?);
                [before, text, behind].concat().into()
            }
        };
        self.keep(name, &whole);
        Some(whole)
    }

    /// Names the long texts of an answer. `names` has for each field `{"keep": NAME}` with the name that the text gets, and
    /// `of` where the page has another one that may be like it. In place of the text the answer has `{"keep": NAME, "text": …}`,
    /// with `of`, `from` and `to` as in a request, and there `line`, how many lines stand before `from`: it and `to` are
    /// starts of lines, or the end. Texts beyond ASCII go as they are, as the page counts no bytes.
    pub fn name_in(&self, answer: &mut Value, names: Value) {
        let (Some(answer), Value::Object(names)) = (answer.as_object_mut(), names) else { return };
        for (field, wanted) in names {
            let Some(Value::String(text)) = answer.get(&field) else { continue };
            let Some(name) = wanted["keep"].as_str().filter(|name| name.len() <= LONGEST_NAME)
            else {
                continue;
            };
            if text.len() < LONG || !text.is_ascii() {
                continue;
            }
            let old = wanted["of"].as_str().and_then(|of| self.find(of));
            let said = match old.as_deref().map(|old| (old, lines_between(old, text))) {
                None => json!({ "keep": name, "text": text }),
                Some((old, (from, end))) => json!({
                    "keep": name, "of": wanted["of"], "from": from, "to": old.len() - end,
                    "line": memchr::memchr_iter(b'\n', &text.as_bytes()[..from]).count(),
                    "text": text[from..text.len() - end],
                }),
            };
            self.keep(name, &Arc::from(text.as_str()));
            answer.insert(field, said);
        }
    }

    fn keep(&self, name: &str, text: &Arc<str>) {
        let mut texts = self.texts();
        texts.push_back((name.to_string(), Arc::clone(text)));
        if texts.len() > MOST {
            texts.pop_front();
        }
    }

    fn find(&self, name: &str) -> Option<Arc<str>> {
        self.texts().iter().find(|(own, _)| own == name).map(|(_, text)| Arc::clone(text))
    }

    fn texts(&self) -> MutexGuard<'_, VecDeque<(String, Arc<str>)>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// How many bytes two texts have in common at their starts and at their ends, in whole lines.
fn lines_between(old: &str, new: &str) -> (usize, usize) {
    let (old, new) = (old.as_bytes(), new.as_bytes());
    let from = same(old.iter(), new.iter());
    let from = memchr::memrchr(b'\n', &new[..from]).map_or(0, |at| at + 1);
    let end = same(old[from..].iter().rev(), new[from..].iter().rev());
    // The first line that is the same begins behind the end of the one before.
    let end = memchr::memchr(b'\n', &new[new.len() - end..]).map_or(0, |at| end - at - 1);
    (from, end)
}

fn same<'a>(one: impl Iterator<Item = &'a u8>, other: impl Iterator<Item = &'a u8>) -> usize {
    one.zip(other).take_while(|(a, b)| a == b).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The field `cl` of a request whose text is said.
    fn cl(texts: &Texts, said: Value) -> Option<Value> {
        let mut request = json!({ "do": "post", "texts": { "cl": said } });
        texts.put_into(&mut request).ok()?;
        assert_eq!(request.as_object().unwrap().len(), 2, "the texts are gone from {request}");
        Some(request["cl"].clone())
    }

    #[test]
    fn a_text_is_kept_changed_and_forgotten() {
        let texts = Texts::default();
        assert_eq!(cl(&texts, json!({ "keep": "a", "text": "GOTO / 1" })), Some(json!("GOTO / 1")));
        assert_eq!(cl(&texts, json!({ "kept": "a" })), Some(json!("GOTO / 1")));
        let change = json!({ "keep": "b", "of": "a", "from": 7, "to": 8, "text": "23" });
        assert_eq!(cl(&texts, change), Some(json!("GOTO / 23")));
        assert_eq!(cl(&texts, json!({ "kept": "b" })), Some(json!("GOTO / 23")));
        for name in 0..MOST - 1 {
            cl(&texts, json!({ "keep": name.to_string(), "text": "" }));
        }
        assert_eq!(cl(&texts, json!({ "kept": "a" })), None);
        assert_eq!(cl(&texts, json!({ "kept": "b" })), Some(json!("GOTO / 23")));
    }

    #[test]
    fn places_outside_of_a_text_or_within_a_letter_name_no_text() {
        let texts = Texts::default();
        cl(&texts, json!({ "keep": "a", "text": "é" }));
        for (from, to) in [(1, 2), (0, 1), (0, 3), (3, 3)] {
            let change = json!({ "keep": "b", "of": "a", "from": from, "to": to, "text": "" });
            assert_eq!(cl(&texts, change), None, "{from} {to}");
        }
        assert_eq!(
            cl(&texts, json!({ "keep": "c", "of": "z", "from": 0, "to": 0, "text": "" })),
            None
        );
        assert_eq!(cl(&texts, json!({ "kept": 1 })), None);
        let mut request = json!({ "do": "files" });
        assert!(texts.put_into(&mut request).is_ok());
        assert_eq!(request, json!({ "do": "files" }));
    }

    /// What an answer says of its text, which is named.
    fn nc(texts: &Texts, text: &str, names: Value) -> Value {
        let mut answer = json!({ "nc": text });
        texts.name_in(&mut answer, json!({ "nc": names }));
        answer["nc"].take()
    }

    #[test]
    fn a_long_text_of_an_answer_is_said_by_the_lines_that_differ() {
        let texts = Texts::default();
        let row = |at: usize| format!("N{at} X{at}.\r\n");
        let old: String = (0..10_000).map(row).collect();
        assert_eq!(nc(&texts, &old, json!({ "keep": "a" })), json!({ "keep": "a", "text": old }));
        // Lines that change, go, come, and none.
        let changes = [(5..7, "N5 X9.\r\n"), (9_990..10_000, ""), (0..0, "%\r\n"), (7..7, "")];
        for (number, (gone, new)) in changes.into_iter().enumerate() {
            let starts = |line: usize| (0..line).map(|at| row(at).len()).sum::<usize>();
            let text = format!("{}{new}{}", &old[..starts(gone.start)], &old[starts(gone.end)..]);
            let name = format!("b{number}");
            let said = nc(&texts, &text, json!({ "keep": name, "of": "a" }));
            let place = |key: &str| said[key].as_u64().unwrap() as usize;
            let (before, behind) = (&old[..place("from")], &old[place("to")..]);
            let made = said["text"].as_str().unwrap();
            assert_eq!(format!("{before}{made}{behind}"), text, "{said}");
            assert_eq!(place("line"), before.lines().count());
            assert!(before.is_empty() || before.ends_with('\n'));
            assert!(made.len() < 100, "{said}");
            assert_eq!(cl(&texts, json!({ "kept": name })), Some(json!(text)));
        }
        // Short texts and those beyond ASCII go as they are.
        let letters = "é\n".repeat(LONG);
        for text in ["G0 X1.\n", &letters] {
            assert_eq!(nc(&texts, text, json!({ "keep": "c", "of": "a" })), json!(text));
        }
    }
}
