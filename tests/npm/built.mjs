// Where what the tests of the npm package look at is.

import { fileURLToPath } from "node:url";

const checkout = fileURLToPath(new URL("../../", import.meta.url));
/** The package's folder: what tests are given, or what `cargo xtask test` has made last. */
export const built = process.env.LUMEN_PACKAGE ?? `${checkout}target/npm-package`;
/** The command line, whose bytes the package's are compared with. */
export const program = process.env.LUMEN_PROGRAM ?? `${checkout}target/debug/lumen`;
