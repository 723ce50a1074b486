//! A content package of IMS QTI 2.1: one item per variant, their figures, and the manifest, in one zip.
//!
//! Source: IMS Question and Test Interoperability, Assessment Test, Section and Item Information Model, version
//! 2.1 final (31 August 2012): `textEntryInteraction`, and `equal` with an absolute tolerance.

use std::io::{Cursor, Write};

use thiserror::Error;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use super::answer::WITHOUT_SENSE;
use super::bank::{Bank, Item, escaped, unit};

/// Why no package was written.
#[derive(Debug, Error)]
#[error("no package could be written: {0}")]
pub struct QtiError(#[from] zip::result::ZipError);

impl From<std::io::Error> for QtiError {
    fn from(error: std::io::Error) -> Self {
        Self(error.into())
    }
}

/// The bytes of the package.
///
/// # Errors
/// When the package outgrows the zip format (4 GiB).
pub fn package(bank: &Bank<'_>) -> Result<Vec<u8>, QtiError> {
    // One date for all, so that the same exam gives the same bytes.
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::default());
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let mut put = |name: &str, text: &str| -> Result<(), QtiError> {
        zip.start_file(name, options)?;
        Ok(zip.write_all(text.as_bytes())?)
    };
    put("imsmanifest.xml", &manifest(bank))?;
    for item in &bank.items {
        let name = item.variant.name();
        put(&format!("items/{name}.xml"), &assessment_item(bank, item))?;
        put(&format!("figures/{name}.svg"), &item.figure)?;
        put(&format!("solutions/{name}.svg"), &item.solution)?;
    }
    Ok(zip.finish()?.into_inner())
}

fn manifest(bank: &Bank<'_>) -> String {
    let resource = |item: &Item<'_>| {
        let name = item.variant.name();
        format!(
            "    <resource identifier=\"item-{name}\" type=\"imsqti_item_xmlv2p1\" href=\"items/{name}.xml\">\n      \
             <file href=\"items/{name}.xml\"/>\n      <file href=\"figures/{name}.svg\"/>\n      <file href=\"solutions/{name}.svg\"/>\n    </resource>\n"
        )
    };
    let resources: String = bank.items.iter().map(resource).collect();
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <manifest xmlns=\"http://www.imsglobal.org/xsd/imscp_v1p1\" identifier=\"linkgram-exam\">\n  \
         <metadata>\n    <schema>QTIv2.1 Package</schema>\n    <schemaversion>1.0.0</schemaversion>\n  </metadata>\n  \
         <organizations/>\n  <resources>\n{resources}  </resources>\n</manifest>\n"
    )
}

/// One item: the figure, and a field for every number; each right number earns a point.
fn assessment_item(bank: &Bank<'_>, item: &Item<'_>) -> String {
    let words = bank.language.words();
    let (mut declarations, mut fields, mut conditions) = (String::new(), String::new(), String::new());
    for (index, (answer, prompt)) in item.variant.answers.iter().zip(&item.prompts).enumerate() {
        let id = format!("ANSWER{}", index + 1);
        let right = answer.printed();
        declarations.push_str(&format!(
            "  <responseDeclaration identifier=\"{id}\" cardinality=\"single\" baseType=\"float\">\n    \
             <correctResponse><value>{right}</value></correctResponse>\n  </responseDeclaration>\n"
        ));
        fields.push_str(&format!(
            "      <p>{}: <textEntryInteraction responseIdentifier=\"{id}\" expectedLength=\"10\"/> {}</p>\n",
            // This version of the format has no element for isolated text of another direction.
            prompt.replace("<bdi dir=\"ltr\">", "<span>").replace("</bdi>", "</span>"),
            unit(&answer.unit)
        ));
        let tolerance = answer.printed_tolerance();
        let equal = |spelling: &String| {
            format!(
                "<equal toleranceMode=\"absolute\" tolerance=\"{tolerance} {tolerance}\"><variable \
                 identifier=\"{id}\"/><baseValue baseType=\"float\">{spelling}</baseValue></equal>"
            )
        };
        let tests: Vec<String> = answer.spellings().iter().map(equal).collect();
        let test = if tests.len() == 1 { tests.concat() } else { format!("<or>{}</or>", tests.concat()) };
        let earns = |marks: f64| {
            format!(
                "<setOutcomeValue identifier=\"SCORE\"><sum><variable identifier=\"SCORE\"/><baseValue \
                 baseType=\"float\">{marks}</baseValue></sum></setOutcomeValue>"
            )
        };
        // A rotation with the wrong sense has its magnitude right.
        let otherwise = answer.opposite().map_or_else(String::new, |other| {
            format!(
                "      <responseElseIf>\n        {}\n        {}\n      </responseElseIf>\n",
                equal(&other),
                earns(answer.weight * WITHOUT_SENSE / 100.0)
            )
        });
        conditions.push_str(&format!(
            "    <responseCondition>\n      <responseIf>\n        {test}\n        {}\n      </responseIf>\n{otherwise}    \
             </responseCondition>\n",
            earns(answer.weight)
        ));
    }
    let name = item.variant.name();
    let points: f64 = item.variant.answers.iter().map(|answer| answer.weight).sum();
    // The solution is shown once the answers are in.
    conditions.push_str(
        "    <setOutcomeValue identifier=\"FEEDBACK\"><baseValue \
         baseType=\"identifier\">solution</baseValue></setOutcomeValue>\n",
    );
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <assessmentItem xmlns=\"http://www.imsglobal.org/xsd/imsqti_v2p1\" identifier=\"item-{name}\" \
         title=\"{}\" adaptive=\"false\" timeDependent=\"false\" xml:lang=\"{}\">\n{declarations}  \
         <outcomeDeclaration identifier=\"SCORE\" cardinality=\"single\" baseType=\"float\" \
         normalMaximum=\"{points}\">\n    <defaultValue><value>0</value></defaultValue>\n  </outcomeDeclaration>\n  \
         <outcomeDeclaration identifier=\"FEEDBACK\" cardinality=\"single\" baseType=\"identifier\"/>\n  \
         <itemBody>\n    <div>\n      <p>{}</p>\n      <p><img src=\"../figures/{name}.svg\" alt=\"{}\"/></p>\n\
         {fields}    </div>\n  </itemBody>\n  <responseProcessing>\n{conditions}  </responseProcessing>\n  \
         <modalFeedback outcomeIdentifier=\"FEEDBACK\" identifier=\"solution\" showHide=\"show\">\n    \
         <p><img src=\"../solutions/{name}.svg\" alt=\"{}\"/></p>\n  </modalFeedback>\n\
         </assessmentItem>\n",
        escaped(&bank.name(item)),
        words.tag,
        escaped(words.by_drawing),
        escaped(words.question),
        escaped(words.results),
    )
}
