//! Counts the arithmetic and the memory traffic of a kernel from its code.
//!
//! Each statement is counted once, by the number of loops around it: a statement inside a loop is the demand of
//! one iteration, however many there are. Of two branches the more expensive one counts, since a group of threads
//! executes both when it diverges. Conditions that are constant when the kernel is linked select their branch.

#[cfg(test)]
mod tests;

use wgpu::naga::{
    AddressSpace, BinaryOperator, Block, Expression, Function, Handle, Literal, MathFunction, Module,
    Statement, TypeInner, UnaryOperator,
    valid::{FunctionInfo, ModuleInfo},
};

use super::Demand;
use crate::device::shader::Linked;

/// Demand by the number of enclosing loops: none, one, two or more.
pub type ByLoops = [Demand; 3];

/// Buffers with per-sample data; all others hold the scene.
const OF_SAMPLES: [&str; 11] = [
    "attributes",
    "list",
    "dispatch",
    "samples",
    "history",
    "history_before",
    "splats",
    "gbuffer",
    "atrous_buffer",
    "atrous_buffer_before",
    "cpu_samples",
];

/// Operations that a special function counts as; GPUs have a quarter as many units for them.
const SPECIAL: f64 = 4.0;

/// Bytes of a texel or a displayed pixel, and bytes that an atomic operation reads and writes.
const TEXEL: f64 = 4.0;
const ATOMIC: f64 = 8.0;

/// Counts a function, or the entry point if no function is named, without the calls of functions in `apart`.
/// `None` if the kernel has no such function.
pub fn count(linked: &Linked, function: Option<&str>, apart: &[&str]) -> Option<ByLoops> {
    let counter = Counter { module: &linked.module, info: &linked.info, apart };
    let mut found = ByLoops::default();
    match function {
        None => {
            let entry = linked.module.entry_points.first()?;
            counter.within(&entry.function, linked.info.get_entry_point(0)).block(
                &entry.function.body,
                0,
                &mut found,
            );
        }
        Some(name) => {
            let mut functions = linked.module.functions.iter();
            let (handle, _) = functions.find(|(_, function)| function.name.as_deref() == Some(name))?;
            counter.function(handle, 0, &mut found);
        }
    }
    Some(found)
}

#[derive(Clone, Copy)]
struct Counter<'m> {
    module: &'m Module,
    info: &'m ModuleInfo,
    apart: &'m [&'m str],
}

/// Counts within the body of one function.
struct Body<'m> {
    counter: Counter<'m>,
    function: &'m Function,
    info: &'m FunctionInfo,
}

impl<'m> Counter<'m> {
    fn within(self, function: &'m Function, info: &'m FunctionInfo) -> Body<'m> {
        Body { counter: self, function, info }
    }

    fn function(self, handle: Handle<Function>, loops: usize, found: &mut ByLoops) {
        let function = &self.module.functions[handle];
        let apart = function.name.as_deref().is_some_and(|name| self.apart.contains(&name));
        if !apart {
            self.within(function, &self.info[handle]).block(&function.body, loops, found);
        }
    }
}

impl Body<'_> {
    /// Adds the demand of a block. Returns whether it always returns.
    fn block(&self, block: &Block, loops: usize, found: &mut ByLoops) -> bool {
        block.iter().any(|statement| self.statement(statement, loops, found))
    }

    fn statement(&self, statement: &Statement, loops: usize, found: &mut ByLoops) -> bool {
        let here = loops.min(found.len() - 1);
        match statement {
            Statement::Emit(range) => {
                for handle in range.clone() {
                    found[here] += self.expression(handle);
                }
            }
            Statement::Block(block) => return self.block(block, loops, found),
            Statement::If { condition, accept, reject } => match self.known(*condition) {
                Some(taken) => return self.block(if taken { accept } else { reject }, loops, found),
                None => return self.longer([accept, reject], loops, found),
            },
            Statement::Switch { cases, .. } => {
                self.longer(cases.iter().map(|case| &case.body), loops, found);
            }
            Statement::Loop { body, continuing, .. } => {
                self.block(body, loops + 1, found);
                self.block(continuing, loops + 1, found);
            }
            Statement::Return { .. } => return true,
            Statement::Store { pointer, value } => {
                found[here] += self.traffic(*pointer, self.bytes(*value));
            }
            Statement::ImageStore { .. } => {
                found[here] += Demand { frame_bytes: TEXEL, ..Demand::default() };
            }
            Statement::Atomic { pointer, .. } => {
                found[here] += self.traffic(*pointer, ATOMIC);
                found[here].operations += 1.0;
            }
            Statement::Call { function, .. } => self.counter.function(*function, loops, found),
            _ => {}
        }
        false
    }

    /// Adds the branch with the greatest demand. Returns whether all of them return.
    fn longer<'b>(
        &self,
        branches: impl IntoIterator<Item = &'b Block>,
        loops: usize,
        found: &mut ByLoops,
    ) -> bool {
        let total = |by: &ByLoops| by.iter().map(|demand| demand.operations).sum::<f64>();
        let mut most = ByLoops::default();
        let mut ends = true;
        for branch in branches {
            let mut own = ByLoops::default();
            ends &= self.block(branch, loops, &mut own);
            if total(&own) > total(&most) {
                most = own;
            }
        }
        for (sum, more) in found.iter_mut().zip(most) {
            *sum += more;
        }
        ends
    }

    /// The value of a condition that is constant in this kernel.
    fn known(&self, condition: Handle<Expression>) -> Option<bool> {
        let literal = match self.function.expressions[condition] {
            Expression::Literal(literal) => literal,
            Expression::Constant(constant) => {
                let init = self.counter.module.constants[constant].init;
                let Expression::Literal(literal) = self.counter.module.global_expressions[init] else {
                    return None;
                };
                literal
            }
            _ => return None,
        };
        if let Literal::Bool(decided) = literal { Some(decided) } else { None }
    }

    fn expression(&self, handle: Handle<Expression>) -> Demand {
        let operations = |count: f64| Demand { operations: count, ..Demand::default() };
        let wide = self.components(handle);
        match self.function.expressions[handle] {
            Expression::Binary { op: BinaryOperator::Divide | BinaryOperator::Modulo, .. } => {
                operations(SPECIAL * wide)
            }
            Expression::Binary { .. } | Expression::Select { .. } => operations(wide),
            // Negation is free, as a modifier of the operand.
            Expression::Unary { op: UnaryOperator::Negate, .. } => Demand::default(),
            Expression::Unary { .. } => operations(wide),
            Expression::As { convert: Some(_), .. } => operations(wide),
            Expression::Relational { argument, .. } => operations(self.components(argument) - 1.0),
            Expression::Math { fun, arg, .. } => operations(function(fun, self.components(arg), wide)),
            Expression::Load { pointer } => self.traffic(pointer, self.bytes(handle)),
            Expression::ImageLoad { .. } => Demand { scene_bytes: TEXEL, ..Demand::default() },
            _ => Demand::default(),
        }
    }

    /// Traffic of an access through `pointer`. Private variables and uniform constants count as none.
    fn traffic(&self, pointer: Handle<Expression>, bytes: f64) -> Demand {
        let mut place = pointer;
        loop {
            match self.function.expressions[place] {
                Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => place = base,
                Expression::GlobalVariable(handle) => {
                    let global = &self.counter.module.global_variables[handle];
                    if !matches!(global.space, AddressSpace::Storage { .. }) {
                        return Demand::default();
                    }
                    let of_samples = global.name.as_deref().is_some_and(|name| OF_SAMPLES.contains(&name));
                    return if of_samples {
                        Demand { frame_bytes: bytes, ..Demand::default() }
                    } else {
                        Demand { scene_bytes: bytes, ..Demand::default() }
                    };
                }
                _ => return Demand::default(),
            }
        }
    }

    fn inner(&self, handle: Handle<Expression>) -> &TypeInner {
        self.info[handle].ty.inner_with(&self.counter.module.types)
    }

    fn bytes(&self, handle: Handle<Expression>) -> f64 {
        f64::from(self.inner(handle).size(self.counter.module.to_ctx()))
    }

    fn components(&self, handle: Handle<Expression>) -> f64 {
        match *self.inner(handle) {
            TypeInner::Vector { size, .. } => f64::from(size as u8),
            TypeInner::Matrix { columns, rows, .. } => f64::from(columns as u8) * f64::from(rows as u8),
            _ => 1.0,
        }
    }
}

/// Operations of a built-in function with `from` components in and `to` components out.
fn function(function: MathFunction, from: f64, to: f64) -> f64 {
    use MathFunction as F;
    match function {
        F::Dot => 2.0 * from - 1.0,
        F::Length => 2.0 * from - 1.0 + SPECIAL,
        F::Distance => 3.0 * from - 1.0 + SPECIAL,
        F::Normalize => 3.0 * from - 1.0 + SPECIAL,
        F::Cross => 9.0,
        F::Reflect => 4.0 * from,
        F::Fma | F::Clamp => 2.0 * to,
        F::Mix => 3.0 * to,
        F::Cos
        | F::Sin
        | F::Tan
        | F::Acos
        | F::Asin
        | F::Atan
        | F::Atan2
        | F::Exp
        | F::Exp2
        | F::Log
        | F::Log2
        | F::Sqrt
        | F::InverseSqrt => SPECIAL * to,
        F::Pow => (2.0 * SPECIAL + 1.0) * to,
        // A shift and a mask for each component.
        F::Unpack4xU8 | F::Unpack2x16unorm | F::Unpack2x16snorm | F::Unpack4x8unorm => 2.0 * to,
        F::Pack2x16unorm | F::Pack2x16snorm | F::Pack4x8unorm => 2.0 * from,
        _ => to,
    }
}
