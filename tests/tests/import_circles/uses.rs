//! What a file imports: enough of Rust's grammar for code that rustfmt has formatted.

/// A name that a file imports or uses by its full path.
#[derive(Clone, Debug)]
pub(crate) struct Use {
    /// Its last word.
    pub(crate) name: String,
    /// From the crate's root; none where it leads to another crate.
    pub(crate) path: Option<Vec<String>>,
    /// Whether it is handed on under its own name.
    pub(crate) public: bool,
}

/// All of a module, but for comments and unit tests.
pub(crate) fn uses(text: &str, module: &str) -> Vec<Use> {
    let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or(text);
    let lines = text.lines().map(|line| line.split("//").next().unwrap_or(line));
    let code = lines.collect::<Vec<_>>().join("\n");
    let children: Vec<&str> = code
        .lines()
        .filter_map(|line| line.trim().strip_suffix(';')?.rsplit_once("mod "))
        .map(|(_, name)| name)
        .collect();
    let mut found = Vec::new();
    let mut rest = String::new();
    for statement in code.split_inclusive(';') {
        let start = statement
            .rfind("use ")
            .filter(|&start| statement[..start].ends_with(['\n', ' ', ')']) || start == 0);
        let Some(start) = start.filter(|_| statement.ends_with(';')) else {
            rest.push_str(statement);
            continue;
        };
        let line = statement[..start].rsplit('\n').next().unwrap_or_default();
        rest.push_str(&statement[..start]);
        let tree = statement[start + 4..].trim_end_matches(';');
        for path in expand("", tree) {
            let name = path.rsplit("::").next().unwrap_or(&path).to_owned();
            let path = from_root(&path, module, &children);
            found.push(Use { name, path, public: line.contains("pub") });
        }
    }
    let plain = |path| Use { name: String::new(), path: Some(path), public: false };
    found.extend(plain_paths(&rest).map(plain));
    found
}

/// The paths of a `use` tree.
fn expand(prefix: &str, tree: &str) -> Vec<String> {
    let mut paths = Vec::new();
    let (mut depth, mut start) = (0, 0);
    let mut parts = Vec::new();
    for (at, letter) in tree.char_indices() {
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&tree[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&tree[start..]);
    for part in parts.into_iter().map(str::trim).filter(|part| !part.is_empty()) {
        match part.split_once('{') {
            Some((head, inner)) => {
                let inner = inner.strip_suffix('}').unwrap_or(inner);
                paths.extend(expand(&format!("{prefix}{head}"), inner));
            }
            None => {
                let name = part.split(" as ").next().unwrap_or(part);
                paths.push(format!("{prefix}{name}"));
            }
        }
    }
    paths
}

/// A path as seen from the root; none where it leads to another crate.
fn from_root(path: &str, module: &str, children: &[&str]) -> Option<Vec<String>> {
    let here: Vec<String> =
        module.split("::").filter(|part| !part.is_empty()).map(str::to_owned).collect();
    let parts: Vec<String> = path.split("::").map(|part| part.trim().to_owned()).collect();
    let (mut start, rest) = match parts.first()?.as_str() {
        "crate" => (Vec::new(), &parts[1..]),
        "super" => (here[..here.len().saturating_sub(1)].to_vec(), &parts[1..]),
        "self" => (here, &parts[1..]),
        child if children.contains(&child) => (here, &parts[..]),
        _ => return None,
    };
    start.extend(rest.iter().filter(|part| *part != "self").cloned());
    Some(start)
}

/// Paths that code outside of `use` starts at the crate's root.
fn plain_paths(code: &str) -> impl Iterator<Item = Vec<String>> {
    code.split("crate::").skip(1).map(|tail| {
        let end = tail.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'));
        let path = &tail[..end.unwrap_or(tail.len())];
        path.split("::").filter(|part| !part.is_empty()).map(str::to_owned).collect()
    })
}
