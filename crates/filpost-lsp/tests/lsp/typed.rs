//! Each message is one of the protocol: it reads as the type that the protocol's own model gives it, and
//! nothing of it is lost.

use gen_lsp_types::{
    CodeActionRequest, CompletionRequest, DefinitionRequest, DocumentFormattingRequest,
    DocumentSymbolRequest, FoldingRangeRequest, HoverRequest, InitializeRequest, InlayHintRequest,
    Notification, PrepareRenameRequest, PublishDiagnosticsNotification, ReferencesRequest,
    RenameRequest, Request, SemanticTokensRequest, SignatureHelpRequest, WorkspaceSymbolRequest,
};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// Fails for an answer that the protocol does not have.
pub fn answer(method: &str, found: &Value) {
    match method {
        "initialize" => result_of::<InitializeRequest>(found),
        "textDocument/codeAction" => result_of::<CodeActionRequest>(found),
        "textDocument/completion" => result_of::<CompletionRequest>(found),
        "textDocument/definition" => result_of::<DefinitionRequest>(found),
        "textDocument/documentSymbol" => result_of::<DocumentSymbolRequest>(found),
        "textDocument/foldingRange" => result_of::<FoldingRangeRequest>(found),
        "textDocument/formatting" => result_of::<DocumentFormattingRequest>(found),
        "textDocument/hover" => result_of::<HoverRequest>(found),
        "textDocument/inlayHint" => result_of::<InlayHintRequest>(found),
        "textDocument/prepareRename" => result_of::<PrepareRenameRequest>(found),
        "textDocument/references" => result_of::<ReferencesRequest>(found),
        "textDocument/rename" => result_of::<RenameRequest>(found),
        "textDocument/semanticTokens/full" => result_of::<SemanticTokensRequest>(found),
        "textDocument/signatureHelp" => result_of::<SignatureHelpRequest>(found),
        "workspace/symbol" => result_of::<WorkspaceSymbolRequest>(found),
        own => assert!(own.starts_with("filpost/"), "{own} is no method of the protocol"),
    }
}

/// Fails for a notification that the protocol does not have.
pub fn notification(method: &str, found: &Value) {
    assert_eq!(method, "textDocument/publishDiagnostics");
    is_whole::<<PublishDiagnosticsNotification as Notification>::Params>(found);
}

fn result_of<R: Request>(found: &Value) {
    is_whole::<R::Result>(found);
}

fn is_whole<T: DeserializeOwned + Serialize>(found: &Value) {
    let read: T =
        serde_json::from_value(found.clone()).unwrap_or_else(|error| panic!("{error}: {found:#}"));
    let again = serde_json::to_value(&read).expect("JSON");
    assert_eq!(&again, found, "the protocol has no such field or value");
}

#[test]
fn what_the_protocol_lacks_is_found() {
    let hover = |text: &str| serde_json::from_str::<Value>(text).expect("JSON");
    answer("textDocument/hover", &hover(r#"{"contents":{"kind":"markdown","value":"x"}}"#));
    for wrong in [
        r#"{"contents":{"kind":"markdown","value":"x"},"rnage":null}"#,
        r#"{"contents":{"kind":"markdown"}}"#,
        r#"{"content":"x"}"#,
    ] {
        let found = hover(wrong);
        let judged = std::panic::catch_unwind(|| answer("textDocument/hover", &found));
        assert!(judged.is_err(), "{wrong}");
    }
}
