//! Requests and notifications, each with its answer.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use fil_ide::{Item, Outline, Position, Range, Script, cl_file, machine};
use filpost::locations::TABLE;
use filpost::{CancelToken, ready};
use serde_json::{Map, Value, json};

use crate::answer;
use crate::documents::{Documents, Kind};
use crate::preview::Preview;
use crate::uri::{path_of, uri_of};

/// A request that can't be answered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// A code of the protocol.
    pub code: i32,
    /// A sentence.
    pub message: String,
}

const INVALID_PARAMS: i32 = -32602;
const METHOD_NOT_FOUND: i32 = -32601;
const REQUEST_FAILED: i32 = -32803;

/// Symbols that a search gives.
const MOST_SYMBOLS: usize = 2000;

/// Items that a completion gives at once.
const MOST_ITEMS: usize = 1500;

type Answer = Result<Value, Fault>;
/// Markdown, and the word it speaks of.
type Hover = (String, Range);

/// The state of one editor's documents.
#[derive(Default)]
pub struct Server {
    documents: Documents,
    /// Documents that have been told of diagnostics, to take them back.
    told: Vec<String>,
}

impl Server {
    /// A server for the parameters of `initialize`.
    pub fn new(params: &Value) -> Self {
        let folder = params.pointer("/workspaceFolders/0/uri").or_else(|| params.get("rootUri"));
        let root = folder.and_then(Value::as_str).and_then(path_of);
        Server { documents: Documents::new(root), told: Vec::new() }
    }

    /// Answers a request.
    ///
    /// # Errors
    /// Wrong parameters, unknown methods, a name that can't be changed.
    pub fn request(&mut self, method: &str, params: &Value) -> Answer {
        match method {
            "workspace/symbol" => return Ok(self.search(params)),
            "filpost/posts" => return Ok(ready::READY.iter().map(|post| post.name).collect()),
            "filpost/preview" => return Ok(self.preview(params)?.answer(&CancelToken::new())),
            _ => {}
        }
        let uri = params.pointer("/textDocument/uri").and_then(Value::as_str);
        let uri =
            uri.ok_or_else(|| fault(INVALID_PARAMS, "textDocument.uri is missing"))?.to_string();
        let position = params.get("position").and_then(answer::read_position);
        let at = || position.ok_or_else(|| fault(INVALID_PARAMS, "position is missing"));
        match method {
            "textDocument/hover" => Ok(self.hover(&uri, at()?)),
            "textDocument/completion" => Ok(self.complete(&uri, at()?)),
            "textDocument/signatureHelp" => Ok(self.signature(&uri, at()?)),
            "textDocument/definition" => {
                Ok(self.places(&uri, |script| script.definition(position.unwrap_or_default())))
            }
            "textDocument/references" => {
                let all = params.pointer("/context/includeDeclaration").and_then(Value::as_bool);
                let at = at()?;
                Ok(self.places(&uri, |script| script.references(at, all.unwrap_or(true))))
            }
            "textDocument/prepareRename" => self.prepare_rename(&uri, at()?),
            "textDocument/rename" => {
                let new = params.get("newName").and_then(Value::as_str);
                let new = new.ok_or_else(|| fault(INVALID_PARAMS, "newName is missing"))?;
                self.rename(&uri, at()?, new)
            }
            "textDocument/documentSymbol" => Ok(self.outline(&uri)),
            "textDocument/foldingRange" => Ok(self.folds(&uri)),
            "textDocument/formatting" => self.format(&uri),
            "textDocument/inlayHint" => Ok(self.inlays(&uri)),
            "textDocument/codeAction" => {
                let range = params.get("range").and_then(answer::read_range);
                let range = range.ok_or_else(|| fault(INVALID_PARAMS, "range is missing"))?;
                Ok(self.fixes(&uri, range))
            }
            "textDocument/semanticTokens/full" => {
                let script = self.documents.script(&uri);
                Ok(answer::tokens(&script.map_or_else(Vec::new, Script::tokens)))
            }
            "filpost/caseOf" => {
                let case = self.documents.case_of(&uri);
                Ok(case.map_or(Value::Null, |case| json!(case.display().to_string())))
            }
            "filpost/settings" => self.settings(&uri),
            "filpost/setting" => self.setting(&uri, params),
            _ => Err(fault(METHOD_NOT_FOUND, method)),
        }
    }

    /// Takes a notification; gives those that are to be sent.
    pub fn notification(&mut self, method: &str, params: &Value) -> Vec<(String, Value)> {
        let uri = params.pointer("/textDocument/uri").and_then(Value::as_str).unwrap_or_default();
        match method {
            "textDocument/didOpen" => {
                let text = |name: &str| {
                    let value = params.pointer(&format!("/textDocument/{name}"));
                    value.and_then(Value::as_str).unwrap_or_default()
                };
                self.documents.set(uri, Some(text("languageId")), text("text"));
            }
            "textDocument/didChange" => {
                let changes = params.get("contentChanges").and_then(Value::as_array);
                let last = changes.and_then(|changes| changes.last()?.get("text")?.as_str());
                if let Some(text) = last {
                    self.documents.set(uri, None, text);
                }
            }
            "textDocument/didClose" => self.documents.close(uri),
            "textDocument/didSave" => {
                self.documents.saved(uri);
                self.documents.forget();
            }
            "workspace/didChangeWatchedFiles" => self.documents.forget(),
            _ => return Vec::new(),
        }
        self.diagnostics(uri)
    }

    /// Diagnostics of the document and of all that share names with it.
    fn diagnostics(&mut self, uri: &str) -> Vec<(String, Value)> {
        let mut found: Vec<(String, Vec<Value>)> = Vec::new();
        if let Some(document) = self.documents.get(uri)
            && document.kind == Some(Kind::Machine)
        {
            let wrong = machine::findings("machine.toml", &document.text);
            found.push((uri.to_string(), wrong.iter().map(answer::finding).collect()));
        }
        for open in self.documents.scripts_open() {
            if let Some(script) = self.documents.script(&open) {
                let findings = script.findings();
                found.push((open, findings.iter().map(answer::finding).collect()));
            }
        }
        let gone = self.told.iter().filter(|told| found.iter().all(|(uri, _)| uri != *told));
        let empty: Vec<(String, Vec<Value>)> = gone.map(|uri| (uri.clone(), Vec::new())).collect();
        self.told = found.iter().map(|(uri, _)| uri.clone()).collect();
        let all = found.into_iter().chain(empty);
        all.map(|(uri, diagnostics)| {
            let params = json!({ "uri": uri, "diagnostics": diagnostics });
            ("textDocument/publishDiagnostics".to_string(), params)
        })
        .collect()
    }

    /// Repairs for what is wrong in a range.
    fn fixes(&mut self, uri: &str, range: Range) -> Value {
        if self.kind(uri) == Some(Kind::Machine) {
            let own = self.documents.get(uri);
            let fixes = own.map_or_else(Vec::new, |own| machine::fixes(uri, &own.text, range));
            return fixes.iter().map(|fix| answer::fix(fix, |_| uri.to_string())).collect();
        }
        let script = self.documents.script(uri);
        let fixes = script.map_or_else(Vec::new, |script| script.fixes(range));
        fixes.iter().map(|fix| answer::fix(fix, |file| uri_of_file(file, uri))).collect()
    }

    /// A case with the documents as they stand in the editor.
    ///
    /// # Errors
    /// No case is named.
    pub fn preview(&self, params: &Value) -> Result<Preview, Fault> {
        let case = params.get("case").and_then(Value::as_str);
        let case = case.ok_or_else(|| fault(INVALID_PARAMS, "case is missing"))?;
        let draws = params.get("plot").and_then(Value::as_bool).unwrap_or(false);
        Ok(Preview { case: PathBuf::from(case), unsaved: self.documents.unsaved(), draws })
    }

    /// The values of a `machine.toml` as they are written, and the rows of the table of settings.
    fn settings(&self, uri: &str) -> Answer {
        let own = self.documents.get(uri).filter(|own| own.kind == Some(Kind::Machine));
        let own = own.ok_or_else(|| fault(REQUEST_FAILED, "no machine.toml"))?;
        let values: Map<String, Value> = machine::values(&own.text)
            .into_iter()
            .map(|(key, value)| (key, json!(value)))
            .collect();
        let rows: Map<String, Value> = TABLE
            .iter()
            .map(|row| {
                let about = json!({
                    "unit": row.unit.to_string(),
                    "default": machine::default_of(row),
                    "acts": row.used,
                    "idle": row.idle,
                });
                (row.name.to_string(), about)
            })
            .collect();
        Ok(json!({ "values": values, "rows": rows }))
    }

    /// The edit that gives a setting of a `machine.toml` a value, or takes it away.
    fn setting(&self, uri: &str, params: &Value) -> Answer {
        let own = self.documents.get(uri).filter(|own| own.kind == Some(Kind::Machine));
        let own = own.ok_or_else(|| fault(REQUEST_FAILED, "no machine.toml"))?;
        let key = params.get("key").and_then(Value::as_str);
        let key = key.ok_or_else(|| fault(INVALID_PARAMS, "key is missing"))?;
        let value = params.get("value").and_then(Value::as_str);
        let edit = machine::edit(&own.text, key, value);
        let (range, text) = edit.map_err(|message| fault(REQUEST_FAILED, &message))?;
        Ok(json!([{ "range": answer::range(range), "newText": text }]))
    }

    fn hover(&mut self, uri: &str, at: Position) -> Value {
        let found = match self.kind(uri) {
            Some(Kind::Fil) => {
                let found = self.documents.script(uri).and_then(|script| script.hover(at));
                found.map(|found| self.with_last_run(uri, found))
            }
            Some(Kind::Machine) => {
                self.documents.get(uri).and_then(|own| machine::hover(&own.text, at))
            }
            Some(Kind::Cl) => self.documents.get(uri).and_then(|own| cl_file::hover(&own.text, at)),
            None => None,
        };
        found.map_or(Value::Null, |(markdown, range)| {
            let contents = json!({ "kind": "markdown", "value": markdown });
            json!({ "contents": contents, "range": answer::range(range) })
        })
    }

    /// A hover, and below it what the word held when its line ran last.
    fn with_last_run(&mut self, uri: &str, (markdown, range): Hover) -> Hover {
        let word = self.documents.get(uri).map(|own| {
            let bytes = own.text.byte(range.start)..own.text.byte(range.end);
            own.text.as_str()[bytes].to_ascii_uppercase()
        });
        let told = word.and_then(|word| self.documents.last_run(uri, range.start.line, &word));
        match told {
            Some(told) => (format!("{markdown}\n\n{told}"), range),
            None => (markdown, range),
        }
    }

    fn complete(&mut self, uri: &str, at: Position) -> Value {
        let items: Vec<Item> = match self.kind(uri) {
            Some(Kind::Fil) => {
                self.documents.script(uri).map_or_else(Vec::new, |script| script.complete(at))
            }
            Some(Kind::Machine) => {
                let own = self.documents.get(uri);
                own.map_or_else(Vec::new, |own| machine::complete(&own.text, at))
            }
            _ => Vec::new(),
        };
        if items.len() <= MOST_ITEMS {
            return items.iter().map(answer::item).collect();
        }
        // Of more than an editor can show: those that begin as what is typed. It asks again.
        let typed = self.typed(uri, at, &items);
        let fits = items.iter().filter(|item| item.label.to_ascii_uppercase().starts_with(&typed));
        let shown: Vec<Value> = fits.take(MOST_ITEMS).map(answer::item).collect();
        json!({ "isIncomplete": true, "items": shown })
    }

    /// What stands before a place of the word that items would replace, in upper case.
    fn typed(&self, uri: &str, at: Position, items: &[Item]) -> String {
        let own = self.documents.get(uri).zip(items.first());
        let typed = own.and_then(|(own, item)| {
            let bytes = own.text.byte(item.range.start)..own.text.byte(at);
            own.text.as_str().get(bytes)
        });
        typed.unwrap_or_default().to_ascii_uppercase()
    }

    fn signature(&mut self, uri: &str, at: Position) -> Value {
        let Some(found) = self.documents.script(uri).and_then(|script| script.signature(at)) else {
            return Value::Null;
        };
        let parameters: Vec<Value> =
            found.parameters.iter().map(|name| json!({ "label": name })).collect();
        json!({
            "signatures": [{
                "label": found.label,
                "documentation": found.doc,
                "parameters": parameters,
            }],
            "activeSignature": 0,
            "activeParameter": found.active,
        })
    }

    fn places(&mut self, uri: &str, ask: impl Fn(&Script) -> Vec<fil_ide::Place>) -> Value {
        let found = self.documents.script(uri).map_or_else(Vec::new, ask);
        let places = found.iter().map(|place| {
            json!({ "uri": uri_of_file(&place.file, uri), "range": answer::range(place.range) })
        });
        places.collect()
    }

    fn prepare_rename(&mut self, uri: &str, at: Position) -> Answer {
        let script =
            self.documents.script(uri).ok_or_else(|| fault(REQUEST_FAILED, "no FIL file"))?;
        let range = script.renamable(at).map_err(|message| fault(REQUEST_FAILED, &message))?;
        Ok(answer::range(range))
    }

    fn rename(&mut self, uri: &str, at: Position, new: &str) -> Answer {
        let script =
            self.documents.script(uri).ok_or_else(|| fault(REQUEST_FAILED, "no FIL file"))?;
        let edits = script.rename(at, new).map_err(|message| fault(REQUEST_FAILED, &message))?;
        Ok(answer::workspace_edit(&edits, |file| uri_of_file(file, uri)))
    }

    fn outline(&mut self, uri: &str) -> Value {
        let entries: Vec<Outline> = match self.kind(uri) {
            Some(Kind::Fil) => self.documents.script(uri).map_or_else(Vec::new, Script::outline),
            Some(Kind::Machine) => {
                self.documents.get(uri).map_or_else(Vec::new, |own| machine::outline(&own.text))
            }
            Some(Kind::Cl) => {
                self.documents.get(uri).map_or_else(Vec::new, |own| cl_file::outline(&own.text))
            }
            None => Vec::new(),
        };
        entries.iter().map(answer::outline).collect()
    }

    /// Symbols whose names hold a text: of the open scripts as they stand in the editor, then
    /// of the other FIL files of the folder, with what all of them include.
    fn search(&mut self, params: &Value) -> Value {
        let query = params.get("query").and_then(Value::as_str).unwrap_or_default();
        let query = query.to_ascii_uppercase();
        let mut seen: HashSet<PathBuf> = HashSet::new();
        let mut found: Vec<Value> = Vec::new();
        let mut add = |entries: &[Outline], uri: &str| {
            let fits = entries.iter().filter(|entry| entry.name.contains(&query));
            found.extend(fits.map(|entry| answer::symbol(entry, uri)));
        };
        for uri in self.documents.scripts_open() {
            let Some(script) = self.documents.script(&uri) else { continue };
            for (file, entries) in script.outlines() {
                let own = uri_of_file(file, &uri);
                let path = path_of(&own).unwrap_or_else(|| PathBuf::from(&own));
                if seen.insert(path.canonicalize().unwrap_or(path)) {
                    add(&entries, &own);
                }
            }
        }
        for (path, entries) in self.documents.symbols_on_disk() {
            if !seen.contains(path) {
                add(entries, &uri_of(path));
            }
        }
        found.truncate(MOST_SYMBOLS);
        Value::Array(found)
    }

    fn folds(&mut self, uri: &str) -> Value {
        let folds = self.documents.script(uri).map_or_else(Vec::new, Script::folds);
        let folds = folds.iter().map(|fold| {
            let kind = if fold.comment { "comment" } else { "region" };
            json!({ "startLine": fold.first, "endLine": fold.last, "kind": kind })
        });
        folds.collect()
    }

    fn format(&mut self, uri: &str) -> Answer {
        let own = self.documents.get(uri).filter(|own| own.kind == Some(Kind::Fil));
        let own = own.ok_or_else(|| fault(REQUEST_FAILED, "no FIL file"))?;
        match filpost::syntax::format(uri, &own.raw) {
            Ok(text) if text == own.raw => Ok(json!([])),
            Ok(text) => Ok(json!([{ "range": answer::range(own.text.whole()), "newText": text }])),
            Err(_) => Err(fault(REQUEST_FAILED, "a text with errors is not formatted")),
        }
    }

    fn inlays(&mut self, uri: &str) -> Value {
        let inlays = self.documents.script(uri).map_or_else(Vec::new, Script::inlays);
        let inlays = inlays.iter().map(|inlay| {
            json!({ "position": answer::position(inlay.position), "label": inlay.label, "kind": 1 })
        });
        inlays.collect()
    }

    fn kind(&self, uri: &str) -> Option<Kind> {
        self.documents.get(uri)?.kind
    }
}

fn fault(code: i32, message: &str) -> Fault {
    Fault { code, message: message.to_string() }
}

/// The URI of a file of an analysis; a document without a path is its own.
fn uri_of_file(file: &str, document: &str) -> String {
    if path_of(document).is_none() {
        return document.to_string();
    }
    let path = Path::new(file);
    let own = path_of(document).is_some_and(|own| own == path);
    if own { document.to_string() } else { uri_of(path) }
}
