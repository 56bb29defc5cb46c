//! What the package's other half has of the Rust one: TypeScript's types of settings, reports and certificate, and the table of
//! settings for the element's sliders. Each is a file of the checkout; the test fails where one is not what it would be, and
//! says how it is written anew.
//!
//! serde-reflection finds out what a type is in JSON by letting it be read from nothing: no type has an attribute for it.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;

use lumen_io::ImportReport;
use lumen_mesh::arrays;
use lumen_pipeline::report::Report;
use lumen_pipeline::settings::table::{self, Kind, Value};
use lumen_pipeline::settings::{Keep, Settings};
use lumen_pipeline::verdict::Remedied;
use lumen_vessel::certificate::{Certificate, StationStatus};
use lumen_vessel::variation;
use serde::Deserialize;
use serde_reflection::{ContainerFormat, Error, Format, Named, Registry, Samples, Tracer, TracerConfig, VariantFormat};

const HEAD: &str = "// Made from Rust: LUMEN_WRITE=1 cargo test -p lumen-npm\n\n";

/// The settings with their ranges, by their names.
fn settings_js() -> String {
    let mut text = format!("{HEAD}export const SETTINGS = {{\n");
    for setting in table::all() {
        let _ = write!(text, "  \"{}\": {{", setting.key);
        if let Some(range) = setting.range() {
            let (least, most) = (range.bounds.start(), range.bounds.end());
            let (unit, decimals, logarithmic) = (range.unit, range.decimals, range.logarithmic);
            let _ = write!(
                text,
                " least: {least}, most: {most}, decimals: {decimals}, unit: \"{unit}\", logarithmic: {logarithmic}"
            );
            if let Some(Value::Number(number)) = setting.default() {
                let _ = write!(text, ", preset: {number}");
            }
            text.push(' ');
        }
        text += "},\n";
    }
    text + "};\n"
}

/// What there is, by its name. An enum is looked at variant by variant, each time that it is said to be unfinished; which are
/// enums tells the attempt before.
fn registry() -> Registry {
    let mut enums = BTreeSet::<String>::new();
    loop {
        let mut tracer = Tracer::new(TracerConfig::default().is_human_readable(true));
        let mut samples = Samples::new();
        // No set of pieces can be made up: it has two or more.
        let pieces = Keep::pieces(&[0, 1]).expect("two are a set");
        for keep in [Keep::Largest, Keep::All, Keep::Component(0), pieces] {
            tracer.trace_value(&mut samples, &keep).expect("a choice can be written");
        }
        for _ in 0..50 {
            enums.iter().for_each(|name| _ = tracer.check_incomplete_enum(name));
            look::<Report>(&mut tracer, &samples);
            look::<ImportReport>(&mut tracer, &samples);
            look::<Certificate>(&mut tracer, &samples);
            look::<Settings>(&mut tracer, &samples);
            // What stands in a list is met there once.
            look::<arrays::Association>(&mut tracer, &samples);
            look::<arrays::Kind>(&mut tracer, &samples);
            look::<arrays::Scalar>(&mut tracer, &samples);
            look::<StationStatus>(&mut tracer, &samples);
            look::<variation::Kind>(&mut tracer, &samples);
            look::<Remedied>(&mut tracer, &samples);
        }
        match tracer.registry() {
            Ok(registry) => return registry,
            Err(Error::MissingVariants(names)) if !names.iter().all(|name| enums.contains(name)) => enums.extend(names),
            Err(why) => panic!("{why:?}"),
        }
    }
}

fn look<'de, T: Deserialize<'de>>(tracer: &mut Tracer, samples: &'de Samples) {
    tracer.trace_type_once::<T>(samples).unwrap_or_else(|why| panic!("{}: {why}", std::any::type_name::<T>()));
}

/// The types.
fn types_ts() -> String {
    let mut text = HEAD.to_owned();
    for (name, container) in registry() {
        match container {
            ContainerFormat::Struct(fields) => {
                let _ = writeln!(text, "export interface {name} {{{}}}\n", of_fields(&fields, "\n  ", ";", "\n"));
            }
            ContainerFormat::Enum(variants) => {
                assert!(variants.len() > 1, "{name} was met once: it has to be looked at by itself");
                let variants: Vec<String> = variants.values().map(of_variant).collect();
                let _ = writeln!(text, "export type {name} = {};\n", variants.join(" | "));
            }
            ContainerFormat::UnitStruct => {
                let _ = writeln!(text, "export type {name} = null;\n");
            }
            ContainerFormat::NewTypeStruct(inner) => {
                let _ = writeln!(text, "export type {name} = {};\n", of(&inner));
            }
            ContainerFormat::TupleStruct(parts) => {
                let _ = writeln!(text, "export type {name} = {};\n", of(&Format::Tuple(parts)));
            }
        }
    }
    text + &by_name()
}

fn of_fields(fields: &[Named<Format>], before: &str, between: &str, after: &str) -> String {
    // Where nothing is mended, nothing is said of it.
    let is_left_out =
        |name: &str| if name == "mending" && fields.iter().any(|field| field.name == "keep") { "?" } else { "" };
    let told =
        |field: &Named<Format>| format!("{before}{}{}: {}", field.name, is_left_out(&field.name), of(&field.value));
    fields.iter().map(told).collect::<Vec<_>>().join(between) + if fields.is_empty() { "" } else { between } + after
}

fn of_variant(variant: &Named<VariantFormat>) -> String {
    let name = &variant.name;
    match &variant.value {
        VariantFormat::NewType(inner) => format!("{{ {name}: {} }}", of(inner)),
        VariantFormat::Tuple(parts) => format!("{{ {name}: {} }}", of(&Format::Tuple(parts.clone()))),
        VariantFormat::Struct(fields) => format!("{{ {name}: {{{} }} }}", of_fields(fields, " ", ";", "")),
        VariantFormat::Unit | VariantFormat::Variable(_) => format!("\"{name}\""),
    }
}

fn of(format: &Format) -> String {
    match format {
        Format::TypeName(name) => name.clone(),
        Format::Unit => "null".to_owned(),
        Format::Bool => "boolean".to_owned(),
        Format::Char | Format::Str => "string".to_owned(),
        Format::Option(inner) => format!("{} | null", of(inner)),
        Format::Seq(inner) if matches!(**inner, Format::Option(_)) => format!("({})[]", of(inner)),
        Format::Seq(inner) => format!("{}[]", of(inner)),
        Format::Map { value, .. } => format!("Record<string, {}>", of(value)),
        Format::Tuple(parts) => format!("[{}]", parts.iter().map(of).collect::<Vec<_>>().join(", ")),
        Format::TupleArray { content, size } => format!("[{}]", vec![of(content); *size].join(", ")),
        Format::Bytes | Format::Variable(_) => "unknown".to_owned(),
        _ => "number".to_owned(),
    }
}

/// The settings by the names that links and the command line have for them.
fn by_name() -> String {
    let mut text = "/** Settings by the names of the command line. */\nexport interface SettingsByName {\n".to_owned();
    for setting in table::all().filter(|setting| setting.key != setting.field) {
        let kind = match &setting.kind {
            Kind::Switch { .. } => "boolean".to_owned(),
            Kind::Number { .. } | Kind::Count { .. } | Kind::Limit { .. } => "number".to_owned(),
            Kind::Choice { names, .. } => {
                names.iter().map(|name| format!("\"{}\"", name.to_lowercase())).collect::<Vec<_>>().join(" | ")
            }
            Kind::Pieces { .. } => "string".to_owned(),
            Kind::Target { named, .. } => {
                named.map_or(String::new(), |(name, _)| format!("\"{}\" | ", name.to_lowercase())) + "number"
            }
        };
        let _ = writeln!(text, "  /** `{}` in a settings file. */\n  \"{}\"?: {kind};", setting.field, setting.key);
    }
    text + "}\n"
}

#[test]
fn files_that_are_made_from_rust_are_as_they_would_be_made() {
    for (name, made) in [("settings.js", settings_js()), ("types.d.ts", types_ts())] {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("js").join(name);
        if std::env::var_os("LUMEN_WRITE").is_some() {
            std::fs::write(&file, &made).unwrap();
        }
        let there = std::fs::read_to_string(&file).unwrap_or_default().replace('\r', "");
        assert!(there == made, "{name} is stale: LUMEN_WRITE=1 cargo test -p lumen-npm");
    }
}
