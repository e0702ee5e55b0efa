// SPDX-License-Identifier: MIT
#include "schema_parts.hpp"

namespace tactus::schema
{

Json base()
{
    // Also the text that editors show for each key.
    return Json::parse (R"json({
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "title": "Tactus graph",
  "description": "A haptic effect as a patch of nodes and wires. Values are SI numbers, or strings with a unit such as \"0.4 mm\". Unknown keys are kept.",
  "type": "object",
  "required": ["format", "version"],
  "properties": {
    "$schema": {"type": "string", "description": "Names this schema, for editors. Tactus keeps it and does not read it."},
    "format": {"const": "tactus-graph", "description": "Marks the file as a graph."},
    "version": {"description": "Version of the file format. Older files are migrated when they are read."},
    "name": {"type": "string", "description": "The displayed name."},
    "about": {"type": "string", "description": "What the effect feels like."},
    "tags": {"type": "array", "items": {"type": "string"}, "description": "Keywords for searching."},
    "rate_hz": {"type": "number", "exclusiveMinimum": 0, "default": 4000, "description": "Ticks per second when no device sets the pace."},
    "devices": {
      "type": "object",
      "propertyNames": {"$ref": "#/$defs/id"},
      "additionalProperties": {"$ref": "#/$defs/device"},
      "description": "A description for each role that device nodes name: a driver such as \"sim\", and its options."
    },
    "nodes": {"$ref": "#/$defs/nodes"},
    "wires": {"$ref": "#/$defs/wires"},
    "expose": {"$ref": "#/$defs/expose"},
    "controls": {
      "type": "object",
      "propertyNames": {"$ref": "#/$defs/id"},
      "additionalProperties": {"$ref": "#/$defs/control"},
      "description": "Knobs from 0 to 1, each moving one or more parameters."
    },
    "graphs": {
      "type": "object",
      "propertyNames": {"$ref": "#/$defs/id"},
      "additionalProperties": {"$ref": "#/$defs/subgraph"},
      "description": "Subgraphs, used by nodes of the type \"graph:NAME\"."
    },
    "plugins": {
      "description": "What to install for nodes that come from plugins: by family or id of the node type, the name of the plugin.",
      "type": "object",
      "additionalProperties": {"type": "string"}
    },
    "ui": {"$ref": "#/$defs/ui"}
  },
  "$defs": {
    "id": {
      "type": "string",
      "pattern": "^[a-z][a-z0-9_]*$",
      "description": "Lower-case letters, digits and _, starting with a letter.",
      "patternErrorMessage": "ids consist of lower-case letters, digits and _, and begin with a letter"
    },
    "endpoint": {
      "type": "string",
      "pattern": "^\\s*[a-z][a-z0-9_]*(?:\\[(?:[0-9]+|\\*)\\])?(?:/[a-z][a-z0-9_]*(?:\\[(?:[0-9]+|\\*)\\])?)*\\.[a-z][a-z0-9_]*(?:\\[[0-9]+\\])?(?:\\.[xyz])?\\s*$",
      "description": "A port: node.port, in[2] for an entry of an array port, .x for a component, / into a subgraph, node[3] for one instance."
    },
    "wire_text": {
      "type": "string",
      "pattern": "^\\s*[a-z][a-z0-9_]*(?:\\[(?:[0-9]+|\\*)\\])?(?:/[a-z][a-z0-9_]*(?:\\[(?:[0-9]+|\\*)\\])?)*\\.[a-z][a-z0-9_]*(?:\\[[0-9]+\\])?(?:\\.[xyz])?\\s*->\\s*(?:\\[\\s*[0-9]*[1-9][0-9]*\\s*\\]\\s*->\\s*)?(?:\\(\\+\\)\\s*)?[a-z][a-z0-9_]*(?:\\[(?:[0-9]+|\\*)\\])?(?:/[a-z][a-z0-9_]*(?:\\[(?:[0-9]+|\\*)\\])?)*\\.[a-z][a-z0-9_]*(?:\\[[0-9]+\\])?(?:\\.[xyz])?\\s*$",
      "description": "\"a.out -> b.in\"; \"a.out -> [1] -> b.in\" delays by one tick; \"a.out -> (+) b.mu\" adds to the parameter's stored value.",
      "patternErrorMessage": "write \"node.port -> node.port\""
    },
    "type": {
      "type": "string",
      "anyOf": [{ "pattern": "^graph:[a-z][a-z0-9_]*$" }, { "pattern": "^file:." }],
      "description": "An id from the catalogue (`tactus nodes`), \"graph:NAME\" for a subgraph of this file, \"file:path.json\" for another file.",
      "errorMessage": "no such type of node; `tactus nodes` lists them"
    },
    "nodes": {
      "type": "object",
      "propertyNames": {"$ref": "#/$defs/id"},
      "additionalProperties": {"$ref": "#/$defs/node"},
      "description": "Nodes by name."
    },
    "node": {
      "type": "object",
      "required": ["type"],
      "not": {"required": ["every", "times"]},
      "properties": {
        "type": {"$ref": "#/$defs/type"},
        "role": {"$ref": "#/$defs/id", "description": "The role of the device that a device node uses."},
        "params": {
          "type": "object",
          "propertyNames": {"$ref": "#/$defs/id"},
          "description": "Parameters: SI numbers, strings with a unit, lists for vectors and arrays, or the name of a choice."
        },
        "settings": {
          "type": "object",
          "propertyNames": {"$ref": "#/$defs/id"},
          "description": "Settings of the node: numbers of inputs, curves, laws, records, surfaces, and paths of files (WAV, PNG, CSV, OBJ …) relative to the folder of the graph."
        },
        "roles": {
          "type": "object",
          "propertyNames": {"$ref": "#/$defs/id"},
          "additionalProperties": {"anyOf": [{"$ref": "#/$defs/id"}, {"type": "array", "items": {"$ref": "#/$defs/id"}}]},
          "description": "For a subgraph: the outer role for each inner role, or a list with one outer role for each instance."
        },
        "overrides": {
          "type": "object",
          "propertyNames": {"pattern": "^\\s*(\\[([0-9]+|\\*)\\]/)?[a-z][^\\s]*\\.[a-z][^\\s]*\\s*$"},
          "description": "For a subgraph: values of parameters inside it, such as \"drag.mu\", or \"[3]/drag.mu\" for one instance."
        },
        "bypass": {"type": "boolean", "default": false, "description": "Pass the inputs through instead of running the node."},
        "count": {"$ref": "#/$defs/count", "description": "The number of instances of the subgraph, which are numbered from 0."},
        "every": {"$ref": "#/$defs/count", "description": "For a subgraph: run only on every k-th tick; hits that arrive in between are added up."},
        "hold": {
          "enum": ["latch", "linear"],
          "description": "For a subgraph with `every`: outputs hold their values between two runs (latch), or move to each new value in a straight line, k ticks late (linear)."
        },
        "times": {
          "$ref": "#/$defs/count",
          "description": "For a subgraph: run m times per tick, on inputs interpolated linearly between ticks; only if no output leads back to the hand."
        },
        "ui": {"$ref": "#/$defs/ui"}
      }
    },
    "count": {"type": "integer", "minimum": 1, "maximum": 1000000},
    "wires": {
      "type": "array",
      "items": {"anyOf": [{"$ref": "#/$defs/wire_text"}, {"$ref": "#/$defs/wire"}]},
      "description": "The connections between ports."
    },
    "wire": {
      "type": "object",
      "required": ["wire"],
      "properties": {
        "wire": {"$ref": "#/$defs/wire_text"},
        "gain": {"$ref": "#/$defs/any_quantity", "description": "A factor for the value on the wire; a unit is included in the unit check."},
        "enabled": {"type": "boolean", "default": true, "description": "Whether the wire is active."},
        "ui": {"$ref": "#/$defs/ui"}
      }
    },
    "expose": {
      "type": "object",
      "properties": {"inputs": {"$ref": "#/$defs/shown"}, "outputs": {"$ref": "#/$defs/shown"}, "params": {"$ref": "#/$defs/shown"}},
      "description": "The ports and parameters that a subgraph exposes, each with the inner port that it refers to."
    },
    "shown": {"type": "object", "propertyNames": {"$ref": "#/$defs/id"}, "additionalProperties": {"$ref": "#/$defs/endpoint"}},
    "control": {
      "type": "object",
      "properties": {
        "name": {"type": "string", "description": "The displayed name."},
        "value": {"type": "number", "minimum": 0, "maximum": 1, "default": 0.5},
        "to": {
          "type": "object",
          "propertyNames": {"$ref": "#/$defs/endpoint"},
          "additionalProperties": {"type": "array", "items": {"$ref": "#/$defs/any_quantity"}, "minItems": 2, "maxItems": 2},
          "description": "Parameters, each with its values when the control is at 0 and at 1."
        },
        "ui": {"$ref": "#/$defs/ui"}
      },
      "required": ["to"]
    },
    "subgraph": {
      "type": "object",
      "properties": {
        "nodes": {"$ref": "#/$defs/nodes"},
        "wires": {"$ref": "#/$defs/wires"},
        "expose": {"$ref": "#/$defs/expose"},
        "ui": {"$ref": "#/$defs/ui"}
      }
    },
    "ui": {"type": "object", "description": "Positions on the screen, comments, groups, colours. None of it changes the effect."}
  }
})json");
}

}   // namespace tactus::schema
