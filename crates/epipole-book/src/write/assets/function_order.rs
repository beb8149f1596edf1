//! Reordering of the functions of a WebAssembly module so that similar ones are adjacent.
//! Compressors find repetitions only nearby (gzip looks back 32 KB), so the download becomes
//! smaller, by some 6% with gzip and 3% with Brotli; the behavior is the same.

use anyhow::{Context, Result, anyhow, ensure};
use std::collections::{HashMap, VecDeque};
use std::convert::Infallible;
use wasm_encoder::reencode::{Error, Reencode};
use wasm_encoder::{CodeSection, FunctionSection, Module};
use wasmparser::{CodeSectionReader, FunctionSectionReader, Parser, Payload, TypeRef};

/// Length of the compared byte sequences.
const RUN: usize = 6;
/// Sequences shared by more functions than this are ignored as uninformative.
const COMMON: usize = 200;
/// Distance over which functions are compared, bytes; somewhat less than gzip's window.
const WINDOW: usize = 30_000;

/// Returns the module with its functions in an order that compresses well and depends only on the
/// bytes.
///
/// # Errors
/// If the bytes are not a WebAssembly module.
pub(super) fn ordered(wasm: &[u8]) -> Result<Vec<u8>> {
    let mut num_imported = 0;
    let mut bodies = Vec::new();
    for payload in Parser::new(0).parse_all(wasm) {
        match payload.context("not a WebAssembly module")? {
            Payload::ImportSection(imports) => {
                for import in imports.into_imports() {
                    num_imported += u32::from(matches!(import?.ty, TypeRef::Func(_)));
                }
            }
            Payload::CodeSectionEntry(body) => bodies.push(body.as_bytes()),
            _ => {}
        }
    }
    let order = by_likeness(&bodies);
    let mut place = vec![0; order.len()];
    for (index, &old) in order.iter().enumerate() {
        place[old] = num_imported + u32::try_from(index)?;
    }
    let mut reordered = Reordered {
        num_imported,
        order,
        place,
    };
    let mut module = Module::new();
    reordered
        .parse_core_module(&mut module, Parser::new(0), wasm)
        .map_err(|problem| anyhow!("a module cannot be put in order: {problem}"))?;
    let bytes = module.finish();
    let before = wasm.len();
    ensure!(
        bytes.len() < before + before / 50,
        "a module of {before} bytes has {} in another order",
        bytes.len()
    );
    Ok(bytes)
}

/// Returns an order in which each function follows the most similar one.
fn by_likeness(bodies: &[&[u8]]) -> Vec<usize> {
    let mut holders: HashMap<&[u8], Vec<usize>> = HashMap::new();
    for (index, body) in bodies.iter().enumerate() {
        for run in body.windows(RUN) {
            let known = holders.entry(run).or_default();
            if known.last() != Some(&index) {
                known.push(index);
            }
        }
    }
    // Indices of informative sequences, in order of first occurrence.
    let mut telling: Vec<Vec<usize>> = Vec::new();
    let mut runs: Vec<Vec<usize>> = vec![Vec::new(); bodies.len()];
    for (index, body) in bodies.iter().enumerate() {
        for run in body.windows(RUN) {
            let Some(known) = holders.remove(run) else {
                continue;
            };
            if known.len() < 2 || known.len() > COMMON {
                continue;
            }
            debug_assert_eq!(known.first(), Some(&index), "runs are met in order");
            for &holder in &known {
                runs[holder].push(telling.len());
            }
            telling.push(known);
        }
    }

    // Long functions have more in common with any other.
    let weight: Vec<f64> = bodies
        .iter()
        .map(|body| 1.0 / (body.len() as f64).sqrt())
        .collect();
    let mut shared = vec![0_i32; bodies.len()];
    let mut counts = vec![0_u32; telling.len()];
    let mut window = VecDeque::new();
    let mut remembered = 0;
    let mut left: Vec<usize> = (0..bodies.len()).collect();
    let mut order = Vec::with_capacity(bodies.len());
    while !left.is_empty() {
        // Of equal values the first wins, for a deterministic order.
        let mut best = 0;
        let mut most = f64::NEG_INFINITY;
        for (at, &index) in left.iter().enumerate() {
            let score = f64::from(shared[index]) * weight[index];
            if score > most {
                (best, most) = (at, score);
            }
        }
        let index = left.remove(best);
        order.push(index);
        window.push_back(index);
        remembered += bodies[index].len();
        for &run in &runs[index] {
            counts[run] += 1;
            if counts[run] == 1 {
                for &holder in &telling[run] {
                    shared[holder] += 1;
                }
            }
        }
        while remembered > WINDOW && window.len() > 1 {
            let Some(gone) = window.pop_front() else {
                break;
            };
            remembered -= bodies[gone].len();
            for &run in &runs[gone] {
                counts[run] -= 1;
                if counts[run] == 0 {
                    for &holder in &telling[run] {
                        shared[holder] -= 1;
                    }
                }
            }
        }
    }
    order
}

/// Encoder that writes a module with its own functions in another order.
struct Reordered {
    num_imported: u32,
    /// Old position by new position, of the module's own functions.
    order: Vec<usize>,
    /// New index among all functions, by old position.
    place: Vec<u32>,
}

impl Reencode for Reordered {
    type Error = Infallible;

    fn function_index(&mut self, index: u32) -> Result<u32, Error<Infallible>> {
        let own = index.checked_sub(self.num_imported);
        Ok(own.map_or(index, |own| self.place[own as usize]))
    }

    fn parse_function_section(
        &mut self,
        functions: &mut FunctionSection,
        section: FunctionSectionReader<'_>,
    ) -> Result<(), Error<Infallible>> {
        let types: Vec<u32> = section.into_iter().collect::<Result<_, _>>()?;
        for index in 0..self.order.len() {
            let kind = self.type_index(types[self.order[index]])?;
            functions.function(kind);
        }
        Ok(())
    }

    fn parse_code_section(
        &mut self,
        code: &mut CodeSection,
        section: CodeSectionReader<'_>,
    ) -> Result<(), Error<Infallible>> {
        let bodies: Vec<_> = section.into_iter().collect::<Result<_, _>>()?;
        for index in 0..self.order.len() {
            self.parse_function_body(code, bodies[self.order[index]].clone())?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wasm_encoder::{
        ConstExpr, ElementSection, Elements, EntityType, ExportKind, ExportSection, Function,
        ImportSection, RefType, TableSection, TableType, TypeSection,
    };
    use wasmparser::{ElementItems, Operator};

    const NUM_FUNCTIONS: u32 = 8;

    /// Functions of two alternating kinds, each calling the next one, after an imported one.
    fn two_kinds() -> Vec<u8> {
        let mut types = TypeSection::new();
        types.ty().function([], []);
        types.ty().function([wasm_encoder::ValType::I32], []);
        let mut imports = ImportSection::new();
        imports.import("page", "hear", EntityType::Function(0));
        let mut functions = FunctionSection::new();
        let mut code = CodeSection::new();
        for index in 0..NUM_FUNCTIONS {
            functions.function(index % 2);
            let mut body = Function::new([]);
            let mut words = body.instructions();
            for step in 0..20 {
                let number = 1000 + step * 40 + 7 * i32::from(index % 2 == 1) * step * step;
                words.i32_const(number).drop();
            }
            words.i32_const(index as i32).drop();
            if index + 1 < NUM_FUNCTIONS {
                if index % 2 == 0 {
                    words.i32_const(5);
                }
                words.call(index + 2);
            } else {
                words.call(0);
            }
            words.end();
            code.function(&body);
        }
        let mut tables = TableSection::new();
        tables.table(TableType {
            element_type: RefType::FUNCREF,
            minimum: 4,
            maximum: None,
            table64: false,
            shared: false,
        });
        let mut exports = ExportSection::new();
        exports.export("begin", ExportKind::Func, 1);
        let mut elements = ElementSection::new();
        elements.active(
            None,
            &ConstExpr::i32_const(0),
            Elements::Functions(vec![4, 0].into()),
        );
        let mut module = Module::new();
        module
            .section(&types)
            .section(&imports)
            .section(&functions)
            .section(&tables)
            .section(&exports)
            .section(&elements)
            .section(&code);
        module.finish()
    }

    /// A module as seen by following its calls.
    struct Followed {
        /// Types and last constants of functions, starting at the export.
        met: Vec<(u32, i32)>,
        /// Constants of the functions in the table.
        table: Vec<Option<i32>>,
        /// Types in the order of the functions.
        kinds: Vec<u32>,
    }

    fn followed(wasm: &[u8]) -> Followed {
        wasmparser::Validator::new().validate_all(wasm).unwrap();
        let (mut types, mut bodies, mut begin, mut table) = (vec![], vec![], 0, vec![]);
        for payload in Parser::new(0).parse_all(wasm) {
            match payload.unwrap() {
                Payload::FunctionSection(section) => {
                    types = section.into_iter().map(Result::unwrap).collect();
                }
                Payload::ExportSection(section) => {
                    begin = section.into_iter().next().unwrap().unwrap().index;
                }
                Payload::ElementSection(section) => {
                    let ElementItems::Functions(items) =
                        section.into_iter().next().unwrap().unwrap().items
                    else {
                        panic!("functions were written");
                    };
                    table = items.into_iter().map(Result::unwrap).collect();
                }
                Payload::CodeSectionEntry(body) => {
                    let (mut constants, mut calls) = (vec![], 0);
                    for operator in body.get_operators_reader().unwrap() {
                        match operator.unwrap() {
                            Operator::I32Const { value } => constants.push(value),
                            Operator::Call { function_index } => calls = function_index,
                            _ => {}
                        }
                    }
                    bodies.push((constants[20], calls));
                }
                _ => {}
            }
        }
        let own = |index: u32| index.checked_sub(1).map(|own| own as usize);
        let (mut met, mut at) = (vec![], begin);
        while let Some(index) = own(at) {
            met.push((types[index], bodies[index].0));
            at = bodies[index].1;
        }
        let in_table = table
            .iter()
            .map(|&index| own(index).map(|own| bodies[own].0));
        Followed {
            met,
            table: in_table.collect(),
            kinds: types,
        }
    }

    #[test]
    fn similar_functions_are_adjacent_and_unchanged() {
        let before = two_kinds();
        let after = ordered(&before).unwrap();
        let (was, is) = (followed(&before), followed(&after));
        assert_eq!(was.met.len(), NUM_FUNCTIONS as usize);
        assert_eq!(is.met, was.met);
        assert_eq!(is.table, was.table);
        assert_eq!(was.table, [Some(3), None]);
        assert_eq!(was.kinds, [0, 1, 0, 1, 0, 1, 0, 1]);
        assert_eq!(is.kinds, [0, 0, 0, 0, 1, 1, 1, 1]);
        assert_eq!(ordered(&before).unwrap(), after, "no chance is in it");
    }

    #[test]
    fn what_is_no_module_is_refused() {
        for bytes in [&b"no module"[..], &two_kinds()[..60]] {
            assert!(ordered(bytes).is_err());
        }
    }
}
