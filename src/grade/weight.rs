//! What a drawing holds, counted before it is read: a reader of XML takes its time for attributes and namespaces that
//! nobody means.

use crate::limits;
use crate::scene::diagnostic::{Fault, Res};

/// Refuses a text that holds more than any drawing does, and declarations that might.
pub(super) fn weigh(text: &str) -> Res<()> {
    let mut scan = Scan { text, at: 0, depth: 0, elements: 0, namespaces: 0, entities: 0, declares: false };
    while let Some(found) = text[scan.at..].find(['<', '&']) {
        scan.at += found;
        if text[scan.at..].starts_with('&') {
            scan.entity()?;
        } else {
            scan.markup()?;
        }
    }
    Ok(())
}

struct Scan<'t> {
    text: &'t str,
    at: usize,
    depth: usize,
    elements: usize,
    namespaces: usize,
    entities: usize,
    /// Whether the document type declares anything.
    declares: bool,
}

fn beyond(at: usize, most: usize, what: &str) -> Fault {
    let fault = Fault::new(at, format!("more than {} {what}", limits::grouped(most)));
    fault.mend("hand in the drawing alone, as a plain SVG")
}

impl Scan<'_> {
    fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    /// Goes on behind the next `end`; to the end of the text where there is none, which the reader will tell.
    fn skip(&mut self, end: &str) {
        self.at = self.rest().find(end).map_or(self.text.len(), |found| self.at + found + end.len());
    }

    fn markup(&mut self) -> Res<()> {
        let rest = self.rest();
        if rest.starts_with("<!--") {
            self.skip("-->");
        } else if rest.starts_with("<![CDATA[") {
            self.skip("]]>");
        } else if rest.starts_with("<?") {
            self.skip("?>");
        } else if rest.starts_with("<!DOCTYPE") {
            self.document_type()?;
        } else if rest.starts_with("</") {
            self.depth = self.depth.saturating_sub(1);
            self.skip(">");
        } else {
            self.element()?;
        }
        Ok(())
    }

    /// A start of an element with its attributes.
    fn element(&mut self) -> Res<()> {
        let start = self.at;
        self.elements += 1;
        if self.elements > limits::ELEMENTS {
            return Err(beyond(start, limits::ELEMENTS, "elements"));
        }
        let (mut attributes, mut quote, mut closed) = (0, None, false);
        let text = self.text;
        let mut end = text.len();
        for (offset, byte) in text.as_bytes()[start..].iter().enumerate() {
            match (quote, *byte) {
                (Some(mark), byte) if byte == mark => quote = None,
                (Some(_), b'&') => {
                    self.at = start + offset;
                    self.count_entity()?;
                }
                (Some(_), _) => {}
                (None, mark @ (b'"' | b'\'')) => quote = Some(mark),
                (None, b'=') => {
                    attributes += 1;
                    let name = text[start..start + offset].trim_ascii_end();
                    let name = name.rsplit(|c: char| c.is_ascii_whitespace() || c == '"' || c == '\'').next();
                    self.namespaces += usize::from(name.is_some_and(|name| name.starts_with("xmlns")));
                }
                (None, b'>') => {
                    closed = text.as_bytes()[start + offset - 1] == b'/';
                    end = start + offset + 1;
                    break;
                }
                _ => {}
            }
            if attributes > limits::ATTRIBUTES {
                return Err(beyond(start, limits::ATTRIBUTES, "attributes of one element"));
            }
            if self.namespaces > limits::NAMESPACES {
                return Err(beyond(start, limits::NAMESPACES, "declarations of namespaces"));
            }
        }
        self.at = end;
        self.depth += usize::from(!closed);
        if self.depth > limits::ELEMENTS_DEEP {
            return Err(beyond(start, limits::ELEMENTS_DEEP, "elements inside one another"));
        }
        Ok(())
    }

    fn entity(&mut self) -> Res<()> {
        self.count_entity()?;
        self.at += 1;
        Ok(())
    }

    /// A use of what the document type declares: without a declaration there is none.
    fn count_entity(&mut self) -> Res<()> {
        let known = ["&amp;", "&lt;", "&gt;", "&quot;", "&apos;", "&#"];
        if self.declares && !known.iter().any(|known| self.rest().starts_with(known)) {
            self.entities += 1;
            if self.entities > limits::ENTITIES {
                return Err(beyond(self.at, limits::ENTITIES, "uses of declared entities"));
            }
        }
        Ok(())
    }

    /// The document type of vector editors: names for addresses. Whatever else could be declared is refused; a file
    /// that it names is never opened.
    fn document_type(&mut self) -> Res<()> {
        let start = self.at;
        let refused = |at: usize, what: &str| {
            let fault = Fault::new(at, format!("the document type {what}"));
            Err(fault.mend("save the drawing as a plain SVG, without a DOCTYPE"))
        };
        let (mut quote, mut inside, mut end) = (None, false, None);
        for (offset, byte) in self.rest().bytes().enumerate().take(limits::DOCTYPE) {
            match (quote, byte) {
                (Some(mark), byte) if byte == mark => quote = None,
                (Some(_), b'&' | b'%' | b'<') if inside => {
                    return refused(start + offset, "declares more than plain texts");
                }
                (Some(_), _) => {}
                (None, mark @ (b'"' | b'\'')) => quote = Some(mark),
                (None, b'%') => return refused(start + offset, "declares more than plain texts"),
                (None, b'[') => inside = true,
                (None, b']') => inside = false,
                (None, b'>') if !inside => {
                    end = Some(start + offset + 1);
                    break;
                }
                _ => {}
            }
        }
        let Some(end) = end else {
            return refused(start, &format!("is longer than {} KiB", limits::DOCTYPE >> 10));
        };
        self.declares |= self.text[start..end].contains("<!ENTITY");
        self.at = end;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(text: &str) -> String {
        weigh(text).map_or_else(|fault| fault.locate("d", text, None).to_string(), |()| "fine".to_owned())
    }

    #[test]
    fn what_an_editor_writes_is_fine() {
        assert_eq!(
            told("<?xml version='1.0'?><!-- <g> --><svg a='<>&amp;'><g b = \"1\"/><![CDATA[<g>]]></svg>"),
            "fine"
        );
        assert_eq!(
            told("<!DOCTYPE svg PUBLIC \"a\" \"b\" [ <!ENTITY n \"http://x\"> ]><svg xmlns=\"&n;\"/>"),
            "fine"
        );
        // What is broken is told by the reader.
        assert_eq!(told("<svg a='"), "fine");
    }

    #[test]
    fn more_than_a_drawing_holds_is_refused() {
        let many = |what: &str, count: usize| what.repeat(count + 1);
        assert!(told(&many("<g>", limits::ELEMENTS_DEEP)).contains("256 elements inside one another"));
        assert!(told(&many("<g/>", limits::ELEMENTS)).contains("100,000 elements"));
        assert!(told(&format!("<g{}/>", many(" a=''", limits::ATTRIBUTES))).contains("256 attributes"));
        assert!(
            told(&many("<g xmlns:a='b'/>", limits::NAMESPACES)).contains("256 declarations of namespaces")
        );
        let typed = |inside: &str| format!("<!DOCTYPE svg [ {inside} ]><svg/>");
        assert!(told(&typed("<!ENTITY a 'b'><!ENTITY c '&a;&a;'>")).contains("more than plain texts"));
        assert!(told(&typed("<!ENTITY % a 'b'>")).contains("more than plain texts"));
        assert!(told(&typed(&many(" ", limits::DOCTYPE))).contains("longer than 8 KiB"));
        let used = format!("<!DOCTYPE svg [<!ENTITY a 'b'>]><svg>{}</svg>", many("&a;", limits::ENTITIES));
        assert!(told(&used).contains("1,000 uses of declared entities"), "{}", told(&used));
    }
}
