//! Long texts that the page has sent before: later requests name them, or say what is different in them.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use serde_json::Value;

/// Texts that are kept; the page keeps as many.
const MOST: usize = 4;

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
        let mut texts = self.texts();
        texts.push_back((name.to_string(), Arc::clone(&whole)));
        if texts.len() > MOST {
            texts.pop_front();
        }
        Some(whole)
    }

    fn find(&self, name: &str) -> Option<Arc<str>> {
        self.texts().iter().find(|(own, _)| own == name).map(|(_, text)| Arc::clone(text))
    }

    fn texts(&self) -> MutexGuard<'_, VecDeque<(String, Arc<str>)>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

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
        for name in ["c", "d", "e"] {
            cl(&texts, json!({ "keep": name, "text": "" }));
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
}
