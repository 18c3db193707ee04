//! Runs the generated WGSL on the CPU: the subset of straight-line f32 functions, no more. An element of
//! `vec3f` is one number here: any of its channels.

use std::collections::HashMap;

/// A value of WGSL: numbers in a row, whatever its type (array, vector or scalar).
pub(crate) type Numbers = Vec<f32>;

/// Runs the body of one generated function for the given arguments, by name (`direction.x` and so on
/// for vectors).
pub(crate) fn run(wgsl: &str, arguments: &[(&str, Numbers)]) -> Numbers {
    let mut names: HashMap<String, Numbers> =
        arguments.iter().map(|(name, value)| ((*name).to_owned(), value.clone())).collect();
    let body = &wgsl[wgsl.find('{').expect("a body") + 1..wgsl.rfind('}').expect("a body")];
    for statement in body.split(';').map(str::trim).filter(|text| !text.is_empty()) {
        let words = statement.split_once(' ').expect("a keyword");
        match words {
            ("let", rest) => {
                let (name, expression) = rest.split_once(" = ").expect("a binding");
                let value = evaluate(expression, &names);
                names.insert(name.to_owned(), value);
            }
            ("var", rest) => {
                let (name, kind) = rest.split_once(": array<vec3f, ").expect("an array");
                let length: usize = kind.trim_end_matches('>').parse().expect("a length");
                names.insert(name.to_owned(), vec![0.0; length]);
            }
            (sum, rest) if rest.starts_with("+= ") => {
                let value = evaluate(&rest[3..], &names)[0];
                let (name, position) = sum.trim_end_matches(']').split_once('[').expect("[");
                let position: usize = position.parse().expect("an index");
                names.get_mut(name).expect("a name")[position] += value;
            }
            ("return", expression) => return evaluate(expression, &names),
            _ => panic!("no straight line: {statement}"),
        }
    }
    panic!("nothing returned");
}

fn evaluate(text: &str, names: &HashMap<String, Numbers>) -> Numbers {
    let mut parser = Parser { rest: text.trim(), names };
    let value = parser.sum();
    assert!(parser.rest.is_empty(), "left over: {}", parser.rest);
    value
}

struct Parser<'a> {
    rest: &'a str,
    names: &'a HashMap<String, Numbers>,
}

impl<'a> Parser<'a> {
    fn eat(&mut self, token: &str) -> bool {
        let found = self.rest.strip_prefix(token);
        if let Some(rest) = found {
            self.rest = rest.trim_start();
        }
        found.is_some()
    }

    fn sum(&mut self) -> Numbers {
        let mut value = self.product();
        loop {
            if self.eat("+") {
                value = vec![value[0] + self.product()[0]];
            } else if self.eat("-") {
                value = vec![value[0] - self.product()[0]];
            } else {
                return value;
            }
        }
    }

    fn product(&mut self) -> Numbers {
        let mut value = self.atom();
        loop {
            if self.eat("*") {
                value = vec![value[0] * self.atom()[0]];
            } else if self.eat("/") {
                value = vec![value[0] / self.atom()[0]];
            } else {
                return value;
            }
        }
    }

    fn word(&mut self) -> &'a str {
        let exponent = |before: Option<char>, c: char| c == '-' && before == Some('e');
        let number = self.rest.starts_with(|c: char| c.is_ascii_digit());
        let mut before = None;
        let end = self
            .rest
            .find(|c: char| {
                let inside = c.is_alphanumeric() || "_.".contains(c);
                let inside = inside || (number && exponent(before, c));
                before = Some(c);
                !inside
            })
            .unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest.trim_start();
        word
    }

    fn atom(&mut self) -> Numbers {
        if self.eat("-") {
            return vec![-self.atom()[0]];
        }
        if self.eat("(") {
            return self.closed();
        }
        let word = self.word();
        if word.starts_with(|c: char| c.is_ascii_digit()) {
            return vec![word.parse().expect("a number")];
        }
        if word == "array" {
            let end = self.rest.find('(').expect("a constructor");
            self.rest = &self.rest[end..];
        }
        if self.eat("(") {
            return call(word, self.list());
        }
        let value = &self.names[word];
        if self.eat("[") {
            let position: usize = self.word().parse().expect("an index");
            assert!(self.eat("]"));
            return vec![value[position]];
        }
        value.clone()
    }

    fn closed(&mut self) -> Numbers {
        let value = self.sum();
        assert!(self.eat(")"), "unclosed before {}", self.rest);
        value
    }

    fn list(&mut self) -> Vec<Numbers> {
        let mut values = Vec::new();
        while !self.eat(")") {
            let value = self.sum();
            // The condition of a select.
            if self.eat("<") {
                let limit = self.sum();
                values.push(vec![f32::from(u8::from(value[0] < limit[0]))]);
            } else {
                values.push(value);
            }
            self.eat(",");
        }
        values
    }
}

fn call(name: &str, arguments: Vec<Numbers>) -> Numbers {
    match name {
        "sqrt" => vec![arguments[0][0].sqrt()],
        "min" => vec![arguments[0][0].min(arguments[1][0])],
        "select" => {
            vec![if arguments[2][0] != 0.0 { arguments[1][0] } else { arguments[0][0] }]
        }
        "array" | "vec2f" | "vec3f" | "vec4f" => arguments.concat(),
        _ => panic!("unknown function {name}"),
    }
}
