//! The arithmetic of a shader function, counted in its text: what the limit of a kernel is made of.

use std::iter::Sum;
use std::ops::{Add, Mul};

use wgpu::naga::front::wgsl;
use wgpu::naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use wgpu::naga::{
    BinaryOperator, Block, Expression, Function, Handle, MathFunction, Module, Range, ScalarKind,
    Statement, TypeInner,
};

use crate::Error;

/// Operations on single floats; those on whole numbers and matrices are not counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Additions, subtractions, multiplications; minima, maxima, absolute values, rounding; unpacking.
    pub simple: u64,
    /// Divisions, roots, powers, exponentials, trigonometry.
    pub special: u64,
}

impl Add for Operations {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { simple: self.simple + other.simple, special: self.special + other.special }
    }
}

impl Mul<u64> for Operations {
    type Output = Self;

    fn mul(self, times: u64) -> Self {
        Self { simple: self.simple * times, special: self.special * times }
    }
}

impl Sum for Operations {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), Add::add)
    }
}

/// Of one call of a function, whose loops run `turns` times: both sides of branches, and nothing saved
/// by an early return.
///
/// # Errors
/// Where the text is no valid WGSL or has no such function.
pub fn operations(wgsl: &str, function: &str, turns: u64) -> Result<Operations, Error> {
    let module = wgsl::parse_str(wgsl).map_err(|e| Error::new(e.to_string()))?;
    let info = Validator::new(ValidationFlags::empty(), Capabilities::all())
        .validate(&module)
        .map_err(|e| Error::new(e.to_string()))?;
    let named = |(_, f): &(_, &Function)| f.name.as_deref() == Some(function);
    let (handle, _) = (module.functions.iter().find(named))
        .ok_or_else(|| Error::new(format!("the shader has no function `{function}`")))?;
    Ok(Counter { module: &module, info: &info, turns }.of_function(handle))
}

struct Counter<'a> {
    module: &'a Module,
    info: &'a ModuleInfo,
    turns: u64,
}

impl Counter<'_> {
    fn of_function(&self, handle: Handle<Function>) -> Operations {
        self.of_block(handle, &self.module.functions[handle].body)
    }

    fn of_block(&self, function: Handle<Function>, block: &Block) -> Operations {
        block.iter().map(|statement| self.of_statement(function, statement)).sum()
    }

    fn of_statement(&self, function: Handle<Function>, statement: &Statement) -> Operations {
        let of = |block| self.of_block(function, block);
        match statement {
            Statement::Emit(range) => self.of_expressions(function, range),
            Statement::Block(block) => of(block),
            Statement::If { accept, reject, .. } => of(accept) + of(reject),
            Statement::Switch { cases, .. } => cases.iter().map(|case| of(&case.body)).sum(),
            Statement::Loop { body, continuing, .. } => (of(body) + of(continuing)) * self.turns,
            Statement::Call { function, .. } => self.of_function(*function),
            _ => Operations::default(),
        }
    }

    fn of_expressions(&self, function: Handle<Function>, range: &Range<Expression>) -> Operations {
        range.clone().map(|handle| self.of_expression(function, handle)).sum()
    }

    fn of_expression(&self, function: Handle<Function>, handle: Handle<Expression>) -> Operations {
        let floats = |handle| self.floats(function, handle);
        match self.module.functions[function].expressions[handle] {
            Expression::Binary { op, .. } => of_operator(op, floats(handle)),
            Expression::Math { fun, arg, .. } => of_math(fun, floats(arg)),
            _ => Operations::default(),
        }
    }

    /// Components of a float vector; 0 of anything else.
    fn floats(&self, function: Handle<Function>, handle: Handle<Expression>) -> u64 {
        let (scalar, size) = match *self.info[function][handle].ty.inner_with(&self.module.types) {
            TypeInner::Scalar(scalar) => (scalar, 1),
            TypeInner::Vector { size, scalar } => (scalar, size as u64),
            _ => return 0,
        };
        if scalar.kind == ScalarKind::Float { size } else { 0 }
    }
}

/// On `n` floats.
fn of_operator(operator: BinaryOperator, n: u64) -> Operations {
    use BinaryOperator::{Add, Divide, Modulo, Multiply, Subtract};
    match operator {
        Add | Subtract | Multiply => Operations { simple: n, special: 0 },
        Divide | Modulo => Operations { simple: 0, special: n },
        _ => Operations::default(),
    }
}

/// Of a vector of `n` floats.
fn of_math(function: MathFunction, n: u64) -> Operations {
    use MathFunction::*;
    let [simple, special] = match function {
        Abs | Sign | Floor | Ceil | Round | Trunc | Min | Max | Step => [n, 0],
        Clamp | Saturate | Fract | Fma => [2 * n, 0],
        Mix => [3 * n, 0],
        SmoothStep => [8 * n, n],
        Dot => [(2 * n).saturating_sub(1), 0],
        Cross => [3 * n, 0],
        Length => [(2 * n).saturating_sub(1), 1],
        Distance => [(3 * n).saturating_sub(1), 1],
        Normalize => [(3 * n).saturating_sub(1), 1],
        Reflect => [4 * n, 0],
        Unpack4x8snorm | Unpack4x8unorm => [4, 0],
        Unpack2x16snorm | Unpack2x16unorm => [2, 0],
        _ => [0, n],
    };
    Operations { simple, special }
}
