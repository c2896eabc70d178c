//! The beginning of a post: from a ready post, or from an option file.

use filpost::{new_post, settings};
use serde_json::{Value, json};

use crate::diagnostics::all;
use crate::fields::Fields;
use crate::{Fault, Misuse, refused};

/// Answers with the `files` of a new post, `{name, text}` of each, as `filpost new` makes them.
pub(crate) fn new_post(mut fields: Fields) -> Result<Value, Misuse> {
    let name = fields.needed("name")?;
    let base = fields.needed("base")?;
    fields.end()?;
    Ok(match new_post::files(&name, &base, &name) {
        Ok(files) => {
            let file = |(name, bytes): (&str, Vec<u8>)| json!({ "name": name, "text": String::from_utf8_lossy(&bytes) });
            json!({ "files": files.into_iter().map(file).collect::<Vec<_>>() })
        }
        Err(error) => refused(&Fault::Setup(error), &[]),
    })
}

/// Answers with the `machine`, the text of a machine.toml, that an option file says, and
/// `warnings`.
pub(crate) fn import(mut fields: Fields) -> Result<Value, Misuse> {
    let name = fields.needed("name")?;
    let text = fields.needed("text")?;
    fields.end()?;
    Ok(match settings::read_option_file(&name, &text) {
        Ok(imported) => {
            let title = Value::String(text.lines().nth(1).unwrap_or_default().trim().into());
            let machine = format!("name = {title}\n\n{}", settings::write_toml(&imported.commons));
            json!({ "machine": machine, "warnings": all(&imported.warnings) })
        }
        Err(diags) => json!({ "errors": all(&diags) }),
    })
}
