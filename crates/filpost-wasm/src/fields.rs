//! The fields of a request. They are taken one by one, so that one that nobody knows is said,
//! and read by hand: derived readers would be a tenth of the module.

use serde_json::Value;

use crate::Misuse;

/// A file by its name for messages, and its text.
pub(crate) struct Named {
    pub name: String,
    pub text: String,
}

/// What a request holds.
pub(crate) struct Fields(Vec<(String, Value)>);

impl Fields {
    /// The fields of an object.
    pub fn of(request: Value) -> Result<Self, Misuse> {
        match request {
            Value::Object(fields) => Ok(Fields(fields.into_iter().collect())),
            other => Err(Misuse(format!("an object is expected, not {other}"))),
        }
    }

    fn take(&mut self, key: &str) -> Option<Value> {
        let at = self.0.iter().position(|(name, _)| name == key)?;
        Some(self.0.remove(at).1).filter(|value| !value.is_null())
    }

    /// A text, where there is one.
    pub fn text(&mut self, key: &str) -> Result<Option<String>, Misuse> {
        match self.take(key) {
            None => Ok(None),
            Some(Value::String(text)) => Ok(Some(text)),
            Some(other) => Err(wrong(key, "a text", &other)),
        }
    }

    /// A text that must be there.
    pub fn needed(&mut self, key: &str) -> Result<String, Misuse> {
        self.text(key)?.ok_or_else(|| Misuse(format!("`{key}` is missing")))
    }

    /// True or false; false where it is left out.
    pub fn flag(&mut self, key: &str) -> Result<bool, Misuse> {
        match self.take(key) {
            None => Ok(false),
            Some(Value::Bool(flag)) => Ok(flag),
            Some(other) => Err(wrong(key, "true or false", &other)),
        }
    }

    /// A number from 0, where there is one.
    pub fn number(&mut self, key: &str) -> Result<Option<u64>, Misuse> {
        let Some(value) = self.take(key) else { return Ok(None) };
        value.as_u64().map(Some).ok_or_else(|| wrong(key, "a whole number", &value))
    }

    /// A value of any kind, where there is one.
    #[cfg(feature = "debug")]
    pub fn value(&mut self, key: &str) -> Option<Value> {
        self.take(key)
    }

    /// A number that may have a point, where there is one.
    #[cfg(feature = "plot")]
    pub fn decimal(&mut self, key: &str) -> Result<Option<f64>, Misuse> {
        let Some(value) = self.take(key) else { return Ok(None) };
        value.as_f64().map(Some).ok_or_else(|| wrong(key, "a number", &value))
    }

    /// Names with a text, a number, true or false; empty where it is left out.
    pub fn named_values(&mut self, key: &str) -> Result<Vec<(String, String)>, Misuse> {
        let Some(value) = self.take(key) else { return Ok(Vec::new()) };
        let Value::Object(values) = value else { return Err(wrong(key, "an object", &value)) };
        let shown = |(name, value): (String, Value)| match value {
            Value::String(text) => Ok((name, text)),
            Value::Number(_) | Value::Bool(_) => Ok((name, value.to_string())),
            other => Err(wrong(&name, "a text, a number, true or false", &other)),
        };
        values.into_iter().map(shown).collect()
    }

    /// A list; empty where it is left out.
    pub fn list(&mut self, key: &str) -> Result<Vec<Value>, Misuse> {
        match self.take(key) {
            None => Ok(Vec::new()),
            Some(Value::Array(list)) => Ok(list),
            Some(other) => Err(wrong(key, "a list", &other)),
        }
    }

    /// A list of texts.
    pub fn texts(&mut self, key: &str) -> Result<Vec<String>, Misuse> {
        let text = |value| match value {
            Value::String(text) => Ok(text),
            other => Err(wrong(key, "a list of texts", &other)),
        };
        self.list(key)?.into_iter().map(text).collect()
    }

    /// A file, where there is one.
    pub fn file(&mut self, key: &str) -> Result<Option<Named>, Misuse> {
        self.take(key).map(named).transpose()
    }

    /// A list of files.
    pub fn files(&mut self, key: &str) -> Result<Vec<Named>, Misuse> {
        self.list(key)?.into_iter().map(named).collect()
    }

    /// All fields have been taken.
    ///
    /// # Errors
    /// The first one that has not.
    pub fn end(self) -> Result<(), Misuse> {
        match self.0.first() {
            Some((key, _)) => Err(Misuse(format!("unknown field `{key}`"))),
            None => Ok(()),
        }
    }
}

fn named(value: Value) -> Result<Named, Misuse> {
    let mut fields = Fields::of(value)?;
    let named = Named { name: fields.needed("name")?, text: fields.needed("text")? };
    fields.end()?;
    Ok(named)
}

fn wrong(key: &str, wanted: &str, found: &Value) -> Misuse {
    Misuse(format!("`{key}` must be {wanted}, not {found}"))
}
