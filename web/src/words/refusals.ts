// Why something is refused: one line that names the key, the rule, the value and the way out.

import type { Row } from "./words";

export const refusals = {
  link_unknown: [
    "“{key}” is no key that the laboratory or this system knows; leave it out.",
    "«{key}» no es una clave que conozcan el laboratorio o este sistema; quítela.",
  ],
  link_empty: [
    "Nothing stands behind the #; write #system=simple&t_max=10, say.",
    "No hay nada tras #; escriba #system=simple&t_max=10, por ejemplo.",
  ],
  link_method: [
    "“method” must be one of {choices} for system={system}; got {value}.",
    "«method» debe ser uno de {choices} para system={system}; se dio {value}.",
  ],
  link_twice: ["“{key}” stands twice; leave one out.", "«{key}» aparece dos veces; quite una."],
  link_no_value: ["“{key}” has no value; write {key}=…", "«{key}» no tiene valor; escriba {key}=…"],
  link_needed: ["“{key}” is needed; write {key}=…", "«{key}» es necesario; escriba {key}=…"],
  link_encoding: [
    "“{key}” is not percent-encoded as UTF-8; copy the link again.",
    "«{key}» no está codificado en UTF-8; copie el enlace de nuevo.",
  ],
  link_choice: [
    "“{key}” must be one of {choices}; got {value}.",
    "«{key}» debe ser uno de {choices}; se dio {value}.",
  ],
  link_number: [
    "“{key}” must be a finite decimal number, got {value}; write it as 1.5 or 2e-3.",
    "«{key}» debe ser un número decimal finito, se dio {value}; escríbalo como 1.5 o 2e-3.",
  ],
  link_count: [
    "“{key}” must hold {count} numbers, got {value}.",
    "«{key}» debe contener {count} números, se dieron {value}.",
  ],
  link_rising: [
    "“{key}” must be two rising numbers, got {value}.",
    "«{key}» debe tener dos números crecientes, se dio {value}.",
  ],
  link_most: [
    "“{key}” takes at most {most}, each once; got {value}.",
    "«{key}» admite como máximo {most}, cada uno una vez; se dio {value}.",
  ],
  link_tiny: [
    "“{key}” is nearer to zero than the smallest number, got {value}; write 0.",
    "«{key}» está más cerca de cero que el menor número, se dio {value}; escriba 0.",
  ],
  link_digits: [
    "“{key}” = {value} is not kept by the page, which computes in doubles; use pendula rerun LINK, or leave it out.",
    "«{key}» = {value} no lo cumple la página, que calcula con doubles; use pendula rerun ENLACE, o quítelo.",
  ],
  rule_number: [
    "{key} must be a number, got {value}.",
    "{key} debe ser un número, se dio {value}.",
  ],
  rule_positive: [
    "{key} must be positive, got {value}.",
    "{key} debe ser positivo, se dio {value}.",
  ],
  rule_not_negative: [
    "{key} must not be negative, got {value}.",
    "{key} no debe ser negativo, se dio {value}.",
  ],
  rule_whole: [
    "{key} must be a whole number, got {value}.",
    "{key} debe ser un número entero, se dio {value}.",
  ],
  rule_range: [
    "{key} must lie between {least} and {most}, got {value}.",
    "{key} debe estar entre {least} y {most}, se dio {value}.",
  ],
  rule_angle: [
    "{key} must have angles below 2²⁶ rad, got {value}; take whole turns off.",
    "{key} debe tener ángulos por debajo de 2²⁶ rad, se dio {value}; quite vueltas enteras.",
  ],
  rule_differs: [
    "{key} must differ from the start’s time, got {value} s.",
    "{key} debe ser distinto del tiempo inicial, se dio {value} s.",
  ],
  rule_step_needed: [
    "{key} is needed by the fixed-step method {method}; give step=0.001, say.",
    "{key} es necesario para el método de paso fijo {method}; dé step=0.001, por ejemplo.",
  ],
  rule_within: [
    "{key} must be above 0 and not exceed the {span} s of the run, got {value} s.",
    "{key} debe ser mayor que 0 y no exceder los {span} s del cálculo, se dio {value} s.",
  ],
  rule_not_taken: [
    "{key} is not taken by {method}; leave it out.",
    "{key} no se admite con {method}; quítelo.",
  ],
  data_too_large: [
    "The file has more than 64 MB; take a shorter recording, or read it in Python: pendula fit FILE",
    "El archivo tiene más de 64 MB; tome una grabación más corta o léalo en Python: pendula fit ARCHIVO",
  ],
  data_format: [
    "The page reads text tables alone; read this one in Python: {command}",
    "La página solo lee tablas de texto; lea este archivo en Python: {command}",
  ],
  data_no_text: [
    "This is no text table; save it as CSV, or read it in Python: pendula fit FILE",
    "No es una tabla de texto; guárdela como CSV o léala en Python: pendula fit ARCHIVO",
  ],
  data_empty: [
    "The file has fewer than two rows of numbers.",
    "El archivo tiene menos de dos filas de números.",
  ],
  data_one_column: [
    "The file has one column; time and angle are needed.",
    "El archivo tiene una columna; hacen falta tiempo y ángulo.",
  ],
  data_no_numbers: [
    "Line {line}: “{cell}” is no number; the table must begin within six lines.",
    "Línea {line}: «{cell}» no es un número; la tabla debe empezar en las seis primeras líneas.",
  ],
  data_no_angle: [
    "No column is an angle ({names}); choose one named theta or angle.",
    "Ninguna columna es un ángulo ({names}); use una llamada theta o ángulo.",
  ],
  data_width: [
    "Line {line}: {count} cells, where the first row has {width}.",
    "Línea {line}: {count} celdas; la primera fila tiene {width}.",
  ],
  data_cell: [
    "Line {line}, column {column}: “{cell}” is no number.",
    "Línea {line}, columna {column}: «{cell}» no es un número.",
  ],
  data_backwards: [
    "Line {line}: the time {now} s does not follow {before} s.",
    "Línea {line}: el tiempo {now} s no sigue a {before} s.",
  ],
} as const satisfies Record<string, Row>;
