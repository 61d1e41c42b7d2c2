"""The JSON schema of scenes, which editors of TOML take."""

import json
import tomllib
from pathlib import Path
from typing import Any

import pytest
from command import run_command

SCHEMA = Path(__file__).parent.parent / "scenes" / "schema.json"
SHIPPED = sorted(SCHEMA.parent.glob("*.toml"))
REMEDY = "run ./hydro schema > scenes/schema.json"


def test_the_schema_is_that_which_the_command_prints() -> None:
    found = run_command("schema")
    assert found.exit_code == 0
    assert SCHEMA.read_text(encoding="utf-8") == found.output, REMEDY


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_shipped_scenes_name_it_in_their_first_line(path: Path) -> None:
    assert path.read_text(encoding="utf-8").startswith(f"#:schema ./{SCHEMA.name}\n")


def _resolved(schema: Any, whole: dict[str, Any]) -> Any:
    return whole["definitions"][schema["$ref"].rpartition("/")[2]] if "$ref" in schema else schema


def test_it_knows_every_key_of_the_shipped_scenes() -> None:
    """Without a validator: of each table, the keys of some alternative contain its keys."""
    whole = json.loads(SCHEMA.read_text(encoding="utf-8"))

    def fits(value: Any, schema: Any) -> bool:
        schema = _resolved(schema, whole)
        if "anyOf" in schema:
            return any(fits(value, one) for one in schema["anyOf"])
        if isinstance(value, dict):
            known = schema.get("properties", {})
            return (
                set(value) <= set(known)
                and set(schema.get("required", ())) <= set(value)
                and all(fits(entry, known[key]) for key, entry in value.items())
            )
        if isinstance(value, list):
            items = schema.get("items", {})
            kinds = items if isinstance(items, list) else [items] * len(value)
            return schema.get("type") == "array" and all(map(fits, value, kinds))
        types = {str: "string", bool: "boolean", int: ("integer", "number"), float: "number"}
        allowed = "const" not in schema or schema["const"] == value
        return (
            allowed and ("enum" not in schema or value in schema["enum"]) and schema.get("type") in types[type(value)]
        )

    for path in SHIPPED:
        scene = tomllib.loads(path.read_text(encoding="utf-8"))
        assert fits(scene, whole), path.name
        assert not fits(scene | {"colour": 1}, whole)


def test_a_validator_accepts_the_shipped_scenes() -> None:
    jsonschema = pytest.importorskip("jsonschema")
    validator = jsonschema.Draft7Validator(json.loads(SCHEMA.read_text(encoding="utf-8")))
    for path in SHIPPED:
        validator.validate(tomllib.loads(path.read_text(encoding="utf-8")))
