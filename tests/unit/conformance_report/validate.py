# SPDX-License-Identifier: GPL-3.0-or-later
"""validate.py json|junit FILE SCHEMA: exit status 0 when the file is as it should be, 77 when the validator is missing."""
import json
import shutil
import subprocess
import sys
import xml.etree.ElementTree as tree

kind, file, schema = sys.argv[1:]
if kind == "json":
    try:
        import jsonschema
    except ImportError:
        sys.exit(77)
    with open(schema) as s, open(file) as f:
        rules = json.load(s)
        jsonschema.Draft7Validator.check_schema(rules)
        jsonschema.validate(json.load(f), rules)
else:
    # What a schema cannot say: the counts.
    for suite in tree.parse(file).getroot():
        assert int(suite.get("tests")) == len(suite.findall("testcase")), suite.attrib
        for found, counter in (("failure", "failures"), ("error", "errors"), ("skipped", "skipped")):
            assert len(suite.findall(f"testcase/{found}")) == int(suite.get(counter)), (suite.attrib, found)
    if shutil.which("xmllint") is None:
        sys.exit(77)
    sys.exit(subprocess.run(["xmllint", "--noout", "--nonet", "--schema", schema, file]).returncode)
