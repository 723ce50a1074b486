"""Reads an exam back with programs of others: the folder is the argument."""

import csv
import io
import os
import sys
import tempfile
import zipfile
from pathlib import Path

import resvg_py
from amc2moodle.moodle2amc._questions import CreateQuestion, QuestionNumerical
from lxml import etree
from qti_convert import upgrade_qti2_to_qti3

exam = Path(sys.argv[1]).resolve()
with open(exam / "key.csv", encoding="utf-8", newline="") as file:
    key = list(csv.DictReader(file))
variants = sorted({line["variant"] for line in key})
numbers = [line for line in key if line["variant"] == variants[0]]


def opens(svg):
    """The figure is drawn by another program."""
    png = bytes(resvg_py.svg_to_bytes(svg_string=svg, background="#ffffff", dpi=96))
    assert png.startswith(b"\x89PNG"), "no picture"


# Moodle, one number each: read by amc2moodle, which has no modular answers: it says so and takes no direction.
figures = 0
with tempfile.TemporaryDirectory() as folder:
    QuestionNumerical.figpath = folder
    for index, number in enumerate(numbers):
        bank = etree.parse(exam / f"moodle-numerical.en.{index + 1:02}.xml")
        questions = bank.findall("question[@type='numerical']")
        assert len(questions) == len(variants)
        for variant, element in zip(variants, questions):
            line = next(l for l in key if l["variant"] == variant and (l["quantity"], l["part"]) == (number["quantity"], number["part"]))
            question = CreateQuestion("numerical", element)
            question.fileExport()
            assert question.fileCreated == [f"{variant}.svg"]
            if index == 0:
                opens(Path(folder, f"{variant}.svg").read_text(encoding="utf-8"))
                figures += 1
            if line["part"] == "direction":
                spelled = sorted(float(text.text) for text in element.findall("answer/text"))
                assert abs(spelled[1] - spelled[0] - 360) < 1e-6 and abs(spelled[2] - spelled[1] - 360) < 1e-6
                assert float(line["answer"]) == spelled[1]
            elif float(line["answer"]) != 0:
                read = question.answers()
                assert float(read.get("target")) == float(line["answer"]), (read.attrib, line)
print(f"{len(variants) * len(numbers)} numerical questions are read by amc2moodle, {figures} figures open")

# Moodle, all numbers in one question.
cloze = etree.parse(exam / "moodle-cloze.en.xml").findall("question[@type='cloze']")
assert len(cloze) == len(variants)
for variant, question in zip(variants, cloze):
    html = etree.fromstring(question.findtext("questiontext/text"))
    assert html.find(".//img").get("src") == f"@@PLUGINFILE@@/{variant}.svg"
    fields = [item.split(":NUMERICAL:=")[1] for item in ["".join(li.itertext()) for li in html.iter("li")]]
    lines = [line for line in key if line["variant"] == variant]
    for field, line in zip(fields, lines, strict=True):
        assert field.startswith(f"{line['answer']}:{line['tolerance']}"), (field, line)
print(f"{len(cloze)} cloze questions")

# QTI: the manifest against the schema of IMS for content packages; the items converted to version 3 by
# citolab-qti-convert, and against the schema of IMS, where there is one. lxml does not follow an IDREF of a schema:
# here the names of the variables are held against their declarations.
schema = etree.XMLSchema(file=os.environ["QTI_XSD"]) if "QTI_XSD" in os.environ else None
packaging = etree.XMLSchema(file=os.environ["IMSCP_XSD"])
with zipfile.ZipFile(exam / "qti.en.zip") as package:
    names = set(package.namelist())
    assert package.testzip() is None
    manifest = etree.parse(io.BytesIO(package.read("imsmanifest.xml")))
    packaging.assertValid(manifest)
    listed = {element.get("href") for element in manifest.iter("{*}file")}
    assert listed | {"imsmanifest.xml"} == names
    for variant in variants:
        text = package.read(f"items/{variant}.xml").decode("utf-8")
        item = etree.fromstring(text.encode("utf-8"))
        if schema is not None:
            schema.assertValid(item)
        declared = {element.get("identifier") for element in item.iter("{*}responseDeclaration", "{*}outcomeDeclaration")}
        asked = {element.get("responseIdentifier") for element in item.iter("{*}textEntryInteraction")}
        used = {element.get("identifier") for element in item.iter("{*}variable", "{*}setOutcomeValue")}
        assert asked | {"SCORE", "FEEDBACK"} == used == declared
        upgraded = etree.fromstring(upgrade_qti2_to_qti3(text).encode("utf-8"))
        entries = list(upgraded.iter("{*}qti-text-entry-interaction"))
        right = [value.text for value in upgraded.iterfind(".//{*}qti-correct-response/{*}qti-value")]
        lines = [line for line in key if line["variant"] == variant]
        assert right == [line["answer"] for line in lines] and len(entries) == len(lines)
        opens(package.read(f"figures/{variant}.svg").decode("utf-8"))
checked = "valid by the schema of IMS" if schema is not None else "not held against the schema of IMS (no QTI_XSD)"
print(f"{len(variants)} QTI items are read by citolab-qti-convert; {checked}; the manifest is valid")
