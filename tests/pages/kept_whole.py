# SPDX-License-Identifier: Apache-2.0
"""Whether a value of the Python package holds all of the JSON value that it was made of."""
import dataclasses
import keyword

LEFT_OUT = object()


def lost(value, json_value, path="result"):
    """Where a value of the package differs from the JSON value that it was made of."""
    if dataclasses.is_dataclass(value):
        members = {}
        for field in dataclasses.fields(value):
            name = field.name.rstrip("_") if keyword.iskeyword(field.name.rstrip("_")) else field.name
            members.update(value.more if field.name == "more" else {name: getattr(value, field.name)})
        assert isinstance(json_value, dict), path
        for name in json_value.keys() - members.keys():
            yield f"{path}.{name} is missing"
        for name, one in members.items():
            inner = json_value.get(name, LEFT_OUT)
            if inner is LEFT_OUT:
                if one is not None:
                    yield f"{path}.{name} is {one!r}, not left out"
            else:
                yield from lost(one, inner, f"{path}.{name}")
    elif isinstance(value, list) and isinstance(json_value, list) and len(value) == len(json_value):
        for at, (one, inner) in enumerate(zip(value, json_value)):
            yield from lost(one, inner, f"{path}[{at}]")
    elif isinstance(value, dict) and isinstance(json_value, dict) and value.keys() == json_value.keys():
        for name, one in value.items():
            yield from lost(one, json_value[name], f"{path}.{name}")
    elif value != json_value:
        yield f"{path} is {value!r}, not {json_value!r}"
