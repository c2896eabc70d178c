//! Code pages that Windows has besides those of the web: the ones of its consoles, and the
//! numbers by which its users know the others.

use std::borrow::Cow;

/// A code page of consoles: ASCII, and these characters for the bytes from 128 on.
pub(crate) struct OemPage {
    /// Its name.
    pub name: &'static str,
    upper: &'static str,
}

/// Western Europe (850), the United States (437), Central Europe (852).
const PAGES: [OemPage; 3] = [
    OemPage { name: "IBM850", upper: UPPER_850 },
    OemPage { name: "IBM437", upper: UPPER_437 },
    OemPage { name: "IBM852", upper: UPPER_852 },
];

const UPPER_850: &str = "ÇüéâäàåçêëèïîìÄÅÉæÆôöòûùÿÖÜø£Ø×ƒ\
     áíóúñÑªº¿®¬½¼¡«»░▒▓│┤ÁÂÀ©╣║╗╝¢¥┐\
     └┴┬├─┼ãÃ╚╔╩╦╠═╬¤ðÐÊËÈıÍÎÏ┘┌█▄¦Ì▀\
     ÓßÔÒõÕµþÞÚÛÙýÝ¯´\u{ad}±‗¾¶§÷¸°¨·¹³²■\u{a0}";
const UPPER_437: &str = "ÇüéâäàåçêëèïîìÄÅÉæÆôöòûùÿÖÜ¢£¥₧ƒ\
     áíóúñÑªº¿⌐¬½¼¡«»░▒▓│┤╡╢╖╕╣║╗╝╜╛┐\
     └┴┬├─┼╞╟╚╔╩╦╠═╬╧╨╤╥╙╘╒╓╫╪┘┌█▄▌▐▀\
     αßΓπΣσµτΦΘΩδ∞φε∩≡±≥≤⌠⌡÷≈°∙·√ⁿ²■\u{a0}";
const UPPER_852: &str = "ÇüéâäůćçłëŐőîŹÄĆÉĹĺôöĽľŚśÖÜŤťŁ×č\
     áíóúĄąŽžĘę¬źČş«»░▒▓│┤ÁÂĚŞ╣║╗╝Żż┐\
     └┴┬├─┼Ăă╚╔╩╦╠═╬¤đĐĎËďŇÍÎě┘┌█▄ŢŮ▀\
     ÓßÔŃńňŠšŔÚŕŰýÝţ´\u{ad}˝˛ˇ˘§÷¸°¨˙űŘř■\u{a0}";

impl OemPage {
    /// The page of a label such as `cp850`, `ibm850` or `850`.
    pub fn named(label: &str) -> Option<&'static OemPage> {
        let number = number(label)?;
        PAGES.iter().find(|page| page.name.strip_prefix("IBM") == Some(number))
    }

    /// Bytes as text; each byte is a character.
    pub fn decode<'b>(&self, bytes: &'b [u8]) -> Cow<'b, str> {
        if let Some(ascii) = std::str::from_utf8(bytes).ok().filter(|text| text.is_ascii()) {
            return ascii.into();
        }
        let upper: Vec<char> = self.upper.chars().collect();
        let one = |byte: &u8| match byte.checked_sub(128) {
            None => char::from(*byte),
            Some(at) => upper[usize::from(at)],
        };
        bytes.iter().map(one).collect::<String>().into()
    }

    /// A text as bytes; `None` where the page lacks a character of it.
    pub fn encode<'t>(&self, text: &'t str) -> Option<Cow<'t, [u8]>> {
        if text.is_ascii() {
            return Some(text.as_bytes().into());
        }
        let one = |letter: char| match u8::try_from(letter) {
            Ok(byte) if byte < 128 => Some(byte),
            _ => {
                let at = self.upper.chars().position(|known| known == letter)?;
                u8::try_from(at + 128).ok()
            }
        };
        text.chars().map(one).collect::<Option<Vec<u8>>>().map(Cow::from)
    }
}

/// What the web calls a code page that Windows has by its number.
pub(crate) fn web_name(label: &str) -> Option<&'static str> {
    Some(match number(label)? {
        "874" => "windows-874",
        "932" => "shift_jis",
        "936" => "gbk",
        "949" => "euc-kr",
        "950" => "big5",
        "1250" => "windows-1250",
        "1251" => "windows-1251",
        "1252" => "windows-1252",
        "1253" => "windows-1253",
        "1254" => "windows-1254",
        "1255" => "windows-1255",
        "1256" => "windows-1256",
        "1257" => "windows-1257",
        "1258" => "windows-1258",
        "65001" => "utf-8",
        _ => return None,
    })
}

/// The number of a label such as `cp850`, `CP-850`, `ibm850`, `windows-932` or `850`.
fn number(label: &str) -> Option<&str> {
    let digits = label.trim().trim_start_matches(|letter: char| !letter.is_ascii_digit());
    let prefix = label.trim().strip_suffix(digits)?.to_ascii_lowercase();
    let known = ["", "cp", "cp-", "cp_", "ibm", "ibm-", "windows-", "oem", "oem-"];
    let plain = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    (plain && known.contains(&prefix.as_str())).then_some(digits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_of_consoles_have_the_letters_of_their_countries() {
        for (label, bytes, text) in [
            (
                "cp850",
                &b"Schlichtfr\x84ser \x9D10, Gr\x94\xE1e 90\xF8"[..],
                "Schlichtfräser Ø10, Größe 90°",
            ),
            ("437", b"Fr\x84ser 90\xF8 \xF1 0.1", "Fräser 90° ± 0.1"),
            ("CP852", b"Fr\x82za, pr\x85m\xD8r", "Fréza, průměr"),
        ] {
            let page = OemPage::named(label).unwrap_or_else(|| panic!("{label}"));
            assert_eq!(page.decode(bytes), text);
            assert_eq!(page.encode(text).as_deref(), Some(bytes));
        }
        assert!(OemPage::named("cp850").is_some_and(|page| page.encode("ДЕТАЛЬ").is_none()));
    }

    #[test]
    fn each_page_has_128_characters_once() {
        for page in PAGES {
            let all: Vec<u8> = (0..=255).collect();
            let text = page.decode(&all);
            assert_eq!(text.chars().count(), 256, "{}", page.name);
            assert_eq!(page.encode(&text).as_deref(), Some(&all[..]), "{}", page.name);
        }
    }

    #[test]
    fn labels_are_numbers_with_known_words_before_them() {
        assert_eq!(web_name("cp932"), Some("shift_jis"));
        assert_eq!(web_name("CP-936"), Some("gbk"));
        for label in ["cp", "50", "850x", "x850", "klingon", "", "cp99999", "iso-8859-1"] {
            assert!(OemPage::named(label).is_none() && web_name(label).is_none(), "{label}");
        }
    }
}
