//! `cargo xtask instructions`: counts the WebAssembly instructions of each stage on the samples, and holds them against
//! those kept in `kept.csv`.
//!
//! An interpreter charges each instruction one unit of fuel. Nothing else on the machine changes the count, so that one
//! run tells a slower stage on any machine. The count is not the time: it knows no cache and no second thread.

#[cfg(not(target_arch = "wasm32"))]
fn main() -> anyhow::Result<()> {
    counting::main()
}

#[cfg(target_arch = "wasm32")]
fn main() {}

#[cfg(not(target_arch = "wasm32"))]
mod counting {
    use std::path::Path;

    use anyhow::{Context as _, Result, bail};
    use wasmi::{Config, Engine, Extern, Func, Linker, Module, Store, Val};

    /// How many times what is kept a stage may take.
    const WORSE: f64 = 1.05;
    /// Fuel for a call: more than any takes.
    const TANK: u64 = 1 << 60;

    pub(crate) fn main() -> Result<()> {
        let arguments: Vec<String> = std::env::args().skip(1).collect();
        let [module, kept, keep @ ..] = arguments.as_slice() else { bail!("usage: MODULE KEPT.csv [--keep]") };
        let counted = count(&std::fs::read(module)?)?;
        if !keep.is_empty() {
            let rows = counted.iter().map(|(name, count)| format!("{name},{count}\n"));
            return Ok(std::fs::write(kept, format!("stage,instructions\n{}", rows.collect::<String>()))?);
        }
        compare(&read(Path::new(kept))?, &counted)
    }

    /// The instructions of every part of every case, by its name.
    fn count(module: &[u8]) -> Result<Vec<(String, u64)>> {
        let mut config = Config::default();
        config.consume_fuel(true);
        let engine = Engine::new(&config);
        let module = Module::new(&engine, module)?;
        let mut store = Store::new(&engine, ());
        let mut linker = Linker::new(&engine);
        // What a page would answer: the clock stands still, and nothing else is asked.
        for import in module.imports() {
            let Some(ty) = import.ty().func() else { bail!("{} is asked for, and no function", import.name()) };
            let nothing = ty.results().iter().map(|&ty| Val::default_for_ty(ty)).collect::<Vec<_>>();
            let answer = Func::new(&mut store, ty.clone(), move |_, _, results| {
                results.clone_from_slice(&nothing);
                Ok(())
            });
            linker.define(import.module(), import.name(), Extern::Func(answer))?;
        }
        store.set_fuel(TANK)?;
        let instance = linker.instantiate_and_start(&mut store, &module)?;
        // wasm-bindgen puts a hash behind each name.
        let called = |name: &str| {
            let found = module
                .exports()
                .find(|export| export.name().strip_prefix(name).is_some_and(|rest| rest.starts_with('_')));
            Ok::<_, anyhow::Error>(found.with_context(|| format!("{name} is not exported"))?.name())
        };
        let begin = instance.get_typed_func::<u32, u32>(&store, called("begin")?)?;
        let advance = instance.get_typed_func::<(), u32>(&store, called("advance")?)?;
        let letter = instance.get_typed_func::<u32, u32>(&store, called("letter")?)?;
        let mut counted: Vec<(String, u64)> = Vec::new();
        for case in 0.. {
            store.set_fuel(TANK)?;
            if begin.call(&mut store, case)? == 0 {
                break;
            }
            loop {
                store.set_fuel(TANK)?;
                let bytes = advance.call(&mut store, ())?;
                let count = TANK - store.get_fuel()?;
                if bytes == 0 {
                    break;
                }
                let letters = (0..bytes).map(|at| Ok(char::from(letter.call(&mut store, at)? as u8)));
                let name = letters.collect::<Result<String>>()?;
                // A stage may run again.
                match counted.iter_mut().find(|(known, _)| *known == name) {
                    Some((_, sum)) => *sum += count,
                    None => counted.push((name, count)),
                }
            }
        }
        Ok(counted)
    }

    fn read(kept: &Path) -> Result<Vec<(String, u64)>> {
        let text = std::fs::read_to_string(kept).with_context(|| format!("{} cannot be read", kept.display()))?;
        let row = |line: &str| {
            let (name, count) = line.split_once(',').context("a row has no comma")?;
            Ok((name.to_owned(), count.parse()?))
        };
        text.lines().skip(1).map(row).collect()
    }

    /// Prints both, and fails if a stage takes more than it did.
    fn compare(kept: &[(String, u64)], counted: &[(String, u64)]) -> Result<()> {
        let mut worse = Vec::new();
        println!("{:<27} {:>14} {:>14} {:>8}", "stage", "kept", "now", "change");
        for (name, now) in counted {
            let before = kept.iter().find(|(kept, _)| kept == name).map(|(_, count)| *count);
            let change = before.map(|before| *now as f64 / before as f64);
            let [before, percent] = match (before, change) {
                (Some(before), Some(change)) => [before.to_string(), format!("{:+.1} %", 100.0 * (change - 1.0))],
                _ => ["-".to_owned(), "new".to_owned()],
            };
            println!("{name:<27} {before:>14} {now:>14} {percent:>8}");
            worse.extend(change.filter(|&change| change > WORSE).map(|_| name.clone()));
        }
        let gone = kept.iter().filter(|(name, _)| !counted.iter().any(|(counted, _)| counted == name));
        worse.extend(gone.map(|(name, _)| format!("{name} (not there any more)")));
        if !worse.is_empty() {
            bail!("more than 5 % worse: {}; `cargo xtask instructions --keep` where that is meant", worse.join(", "));
        }
        Ok(())
    }
}
