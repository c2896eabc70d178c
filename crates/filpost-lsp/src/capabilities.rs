//! What this server can do, as it tells the editor.

use fil_ide::TOKEN_TYPES;
use serde_json::{Value, json};

/// The capabilities of the answer to `initialize`.
pub(crate) fn own() -> Value {
    json!({
        "positionEncoding": "utf-16",
        // The whole text with each change.
        "textDocumentSync": { "openClose": true, "change": 1, "save": true },
        "hoverProvider": true,
        "completionProvider": { "triggerCharacters": ["/", ",", "(", "=", "'"] },
        "signatureHelpProvider": { "triggerCharacters": ["(", ",", "/"] },
        "definitionProvider": true,
        "referencesProvider": true,
        "renameProvider": { "prepareProvider": true },
        "documentSymbolProvider": true,
        "workspaceSymbolProvider": true,
        "foldingRangeProvider": true,
        "documentFormattingProvider": true,
        "inlayHintProvider": true,
        "codeActionProvider": { "codeActionKinds": ["quickfix"] },
        "semanticTokensProvider": {
            "legend": { "tokenTypes": TOKEN_TYPES, "tokenModifiers": [] },
            "full": true,
        },
    })
}
