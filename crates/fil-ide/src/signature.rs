//! The call that is being written.

use filpost::builtins::BUILTINS;
use filpost::postf::POSTF;
use filpost::resolve::SymbolKind;

use crate::context::{self, open_call, slash};
use crate::script::Script;
use crate::tables;
use crate::text::Position;

/// How a call is written, and which argument is next.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signature {
    /// The whole call.
    pub label: String,
    /// What it does.
    pub doc: String,
    /// The arguments as they stand in the label.
    pub parameters: Vec<String>,
    /// The one that is written, 0-based.
    pub active: u32,
}

impl Script {
    /// The call around a place.
    pub fn signature(&self, position: Position) -> Option<Signature> {
        let before = context::before(&self.text, self.text.byte(position));
        if before.comment {
            return None;
        }
        let statement = &before.statement;
        if let Some((name, arguments)) = open_call(statement) {
            return of_function(name, &arguments);
        }
        match slash(statement)? {
            ("CALL", items) => self.of_macro(&items),
            (word, items) => {
                let form = tables::form_of(word)?;
                let parameters = context::parts(form.split_once('/')?.1);
                Some(Signature {
                    label: form.to_string(),
                    doc: String::new(),
                    parameters: parameters.iter().map(|part| (*part).to_string()).collect(),
                    active: items.len() as u32 - 1,
                })
            }
        }
    }

    fn of_macro(&self, items: &[&str]) -> Option<Signature> {
        let name = items.first()?.trim();
        let symbols = &self.analysis.resolution.symbols;
        let id = symbols
            .iter()
            .position(|symbol| symbol.kind == SymbolKind::Macro && symbol.name == name)?;
        let own = symbols
            .iter()
            .filter(|symbol| symbol.kind == SymbolKind::Parameter && symbol.owner == Some(id));
        let parameters: Vec<String> = own.map(|symbol| symbol.name.clone()).collect();
        let last = items.last()?.split('=').next()?.trim();
        let named = parameters.iter().position(|parameter| parameter == last);
        let active = named.unwrap_or(items.len().saturating_sub(2)) as u32;
        let list: Vec<String> = parameters.iter().map(|name| format!(",{name}")).collect();
        let label = format!("CALL/{name}{}", list.concat());
        Some(Signature { label, doc: String::new(), parameters, active })
    }
}

fn of_function(name: &str, arguments: &[&str]) -> Option<Signature> {
    let active = arguments.len() as u32 - 1;
    if name == "POSTF" {
        let number: Option<u16> = arguments.first().and_then(|number| number.trim().parse().ok());
        let row = POSTF.iter().find(|row| Some(row.number) == number).filter(|_| active > 0);
        let Some(row) = row else {
            let parameters = vec!["n".to_string()];
            let doc = "talks to the post".to_string();
            return Some(Signature { label: "POSTF(n,…)".into(), doc, parameters, active: 0 });
        };
        let mut parameters = vec![row.number.to_string()];
        parameters.extend(row.arguments.iter().map(|name| (*name).to_string()));
        let label = tables::postf_call(row);
        return Some(Signature { label, doc: row.doc.to_string(), parameters, active });
    }
    let row = BUILTINS.iter().find(|row| row.name == name)?;
    let parameters = row.arguments.split(',').map(|part| part.trim_matches(['[', ']']).to_string());
    Some(Signature {
        label: row.call(),
        doc: row.doc.to_string(),
        parameters: parameters.filter(|part| !part.is_empty()).collect(),
        active,
    })
}
