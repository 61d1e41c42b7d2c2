"""The JSON schema of scenes, by which editors of TOML complete and check what is typed."""

from __future__ import annotations

import json
from math import isinf
from typing import Any

from pydantic.json_schema import models_json_schema

from hydroelastic.scenes.models.level_tank import LevelTankScene
from hydroelastic.scenes.models.round_tank import CanalScene, RoundTankScene
from hydroelastic.scenes.read import SCENE_MODELS, SHIPPED_FOLDER

SCHEMA_FILE = SHIPPED_FOLDER / "schema.json"
"""The schema that comes with the package: the output of the command ``schema``."""


def scene_schema() -> dict[str, Any]:
    """Return the schema; of what depends on several keys it knows nothing."""
    models = (*SCENE_MODELS.values(), LevelTankScene, RoundTankScene, CanalScene)
    references, schema = models_json_schema([(model, "validation") for model in models])
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "Scene of hydroelastic",
        "type": "object",
        "required": ["kind"],
        "anyOf": [_in_json(references[model, "validation"]) for model in models],
        "definitions": _in_json(schema["$defs"]),
    }


def schema_text() -> str:
    """Return the schema as a file holds it."""
    return json.dumps(scene_schema(), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


# Words of pydantic and those of draft 7, which editors know. A table without a kind may fit several.
_WORDS = {"prefixItems": "items", "oneOf": "anyOf"}


def _in_json(value: Any) -> Any:
    """The definitions in draft 7, without infinite limits, which JSON does not have."""
    if isinstance(value, dict):
        return {
            _WORDS.get(key, key): _in_json(entry)
            for key, entry in value.items()
            if not (isinstance(entry, float) and isinf(entry)) and key != "discriminator"
        }
    if isinstance(value, list):
        return [_in_json(entry) for entry in value]
    return value.replace("#/$defs/", "#/definitions/") if isinstance(value, str) else value
