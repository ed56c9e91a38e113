/**
 * What there is: systems with their forms and parameters, methods, options and rules. catalogue.json holds the rows of
 * the core that Python reads too; scripts/lab_catalogue.py writes it, and a test compares the two.
 */
import rows from "./catalogue.json";

/** A parameter of a form. */
export interface ParameterRow {
  readonly name: string;
  /** SI; "": a pure number. */
  readonly unit: string;
  /** Taken where no value is named; null: one has to be named, or is that of `same_as`. */
  readonly standard: number | null;
  readonly range: "positive" | "not_negative" | "any";
  /** One phrase, lower case, in English. */
  readonly meaning: string;
  /** The parameter whose value is taken where none is named; "": none. */
  readonly same_as: string;
  /** Ends of a slider; typed values may lie outside. */
  readonly slider: readonly [number, number];
}

/** One way to describe a system. */
export interface FormRow {
  /** "" where the system has one form only. */
  readonly name: string;
  readonly meaning: string;
  readonly parameters: readonly ParameterRow[];
}

/** A component of the state. */
export interface ComponentRow {
  readonly name: string;
  readonly unit: string;
  readonly standard: number;
  readonly meaning: string;
}

/** What a system can: see Capabilities in Python. */
export interface Capabilities {
  readonly conservative: boolean;
  readonly autonomous: boolean;
  readonly closed_form: boolean;
  readonly period: boolean;
  readonly mapped: boolean;
  readonly periodic: boolean;
  readonly degrees_of_freedom: number;
}

export interface SystemRow {
  readonly name: string;
  readonly components: readonly ComponentRow[];
  readonly forms: readonly FormRow[];
  readonly capabilities: Capabilities;
  /** Names of the constants that its equations are written in. */
  readonly constants: readonly string[];
  /** Names of what does work on it, and of what turns its energy into heat. */
  readonly works: readonly string[];
  readonly heats: readonly string[];
}

export interface MethodRow {
  readonly name: string;
  readonly order: number;
  /** 0: it iterates. */
  readonly evaluations_per_step: number;
  readonly adaptive: boolean;
  readonly symplectic: boolean;
  readonly needs: string;
  /** Names of the systems it takes. */
  readonly systems: readonly string[];
  readonly source: string;
}

/** An option of a run. */
export interface OptionRow {
  readonly name: string;
  readonly unit: string;
  readonly whole: boolean;
  /** Of its range; 0: above 0. */
  readonly least: number;
  /** null: no limit. */
  readonly most: number | null;
  readonly example: number;
  readonly taken_by: string;
  readonly meaning: string;
  readonly otherwise: string;
}

/** The sentences of a rule, after the argument's name; templates. */
export interface RuleRow {
  readonly english: string;
  readonly way_out_in_english: string;
  readonly spanish: string;
  readonly way_out_in_spanish: string;
}

export interface Catalogue {
  /** Of the package that the rows are of. */
  readonly version: string;
  readonly systems: readonly SystemRow[];
  readonly methods: readonly MethodRow[];
  readonly options: readonly OptionRow[];
  readonly rules: Readonly<Record<string, RuleRow>>;
}

export const catalogue = rows as unknown as Catalogue;

/** The system of that name; undefined: there is none. */
export function systemNamed(name: string): SystemRow | undefined {
  return catalogue.systems.find((row) => row.name === name);
}

/** The form of that name of a system; undefined: there is none. */
export function formOf(system: SystemRow, name: string): FormRow | undefined {
  return system.forms.find((row) => row.name === name);
}

/** The method of that name; undefined: there is none. */
export function methodNamed(name: string): MethodRow | undefined {
  return catalogue.methods.find((row) => row.name === name);
}
