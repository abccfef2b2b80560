//! Rules of style sheets, found by what their last compound selector asks for, as browsers find them: an element is compared only
//! with rules of its own id, of one of its classes or of its name, and with those that ask for none of these.

use std::cell::{Cell, RefCell};
use std::collections::HashMap;

use roxmltree::Node;
use simplecss::{AttributeOperator, Declaration, Element, PseudoClass, Selector, StyleSheet};

use super::{marked, sheets};
use crate::scene::Problem;

/// Most steps of comparing elements with the rules of style sheets.
const MAX_STEPS: u64 = 60_000_000;

/// Rules with something of each, the weightiest last.
#[derive(Debug)]
pub(super) struct Rules<'doc, T> {
    all: Vec<(Selector<'doc>, T)>,
    /// Where the rules stand that ask for this id, class or name.
    by_id: HashMap<String, Vec<usize>>,
    by_class: HashMap<String, Vec<usize>>,
    by_name: HashMap<String, Vec<usize>>,
    /// Where the others stand.
    others: Vec<usize>,
}

impl<T> Default for Rules<'_, T> {
    fn default() -> Self {
        Self {
            all: Vec::new(),
            by_id: HashMap::new(),
            by_class: HashMap::new(),
            by_name: HashMap::new(),
            others: Vec::new(),
        }
    }
}

impl<'doc> Rules<'doc, Vec<Declaration<'doc>>> {
    /// Those of the style sheets below `root` that usvg reads.
    pub(super) fn below(root: Node<'doc, 'doc>) -> Self {
        let mut sheet = StyleSheet::new();
        for node in root.descendants().filter(|node| node.tag_name().name() == "style") {
            if matches!(node.attribute("type"), None | Some("text/css")) {
                sheets::parse(&mut sheet, node.text().unwrap_or(""));
            }
        }
        let rules = sheet.rules.into_iter();
        Self::of(rules.map(|rule| (rule.selector, rule.declarations)))
    }
}

impl<'doc, T> Rules<'doc, T> {
    /// Those of which `of_interest` makes something.
    pub(super) fn filter_map<U>(self, of_interest: impl Fn(T) -> Option<U>) -> Rules<'doc, U> {
        let rules = self.all.into_iter();
        Rules::of(rules.filter_map(|(selector, what)| Some((selector, of_interest(what)?))))
    }

    fn of(rules: impl Iterator<Item = (Selector<'doc>, T)>) -> Self {
        let mut found = Self::default();
        for (at, (selector, what)) in rules.enumerate() {
            let asked = Asked::by(&selector);
            let place = match (asked.id, asked.class, asked.name) {
                (Some(id), _, _) => found.by_id.entry(id).or_default(),
                (None, Some(class), _) => found.by_class.entry(class).or_default(),
                (None, None, Some(name)) => found.by_name.entry(name).or_default(),
                (None, None, None) => &mut found.others,
            };
            place.push(at);
            found.all.push((selector, what));
        }
        found
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.all.len()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// What belongs to the rules that select `node`, the weightiest last; `steps` counts the comparisons.
    pub(super) fn matching<'r>(
        &'r self,
        node: Node<'doc, 'doc>,
        steps: &'r Cell<u64>,
    ) -> impl Iterator<Item = &'r T> + use<'r, 'doc, T> {
        let of_id = node.attribute("id").and_then(|id| self.by_id.get(id));
        let classes = node.attribute("class").unwrap_or("").split(' ');
        let of_classes = classes.filter_map(|class| self.by_class.get(class));
        let of_name = self.by_name.get(node.tag_name().name());
        let lists = of_classes.chain(of_id).chain(of_name).chain([&self.others]);
        let mut places: Vec<usize> = lists.flatten().copied().collect();
        places.sort_unstable();
        // A class may be named twice.
        places.dedup();
        let rules = places.into_iter().map(|at| &self.all[at]);
        rules.filter_map(move |(selector, what)| {
            steps.set(steps.get() + 1);
            selector.matches(&Counted { node, steps }).then_some(what)
        })
    }
}

/// What is wrong where elements are compared with rules in so many steps.
pub(super) fn too_many(steps: u64) -> Option<Problem> {
    (steps > MAX_STEPS).then(|| Problem::TooMuch {
        what: "comparisons of elements with style sheets",
        limit: usize::try_from(MAX_STEPS).unwrap_or(usize::MAX),
        cure: "select by classes and ids, or by fewer rules",
    })
}

/// An element that counts how often it, and those around it, are asked.
struct Counted<'c, 'doc> {
    node: Node<'doc, 'doc>,
    steps: &'c Cell<u64>,
}

impl Counted<'_, '_> {
    /// Counts a step; whether there may be more.
    fn step(&self) -> bool {
        self.steps.set(self.steps.get() + 1);
        self.steps.get() <= MAX_STEPS
    }
}

impl Element for Counted<'_, '_> {
    fn parent_element(&self) -> Option<Self> {
        let node = self.node.parent_element().filter(|_| self.step())?;
        Some(Self {
            node,
            steps: self.steps,
        })
    }

    fn prev_sibling_element(&self) -> Option<Self> {
        let node = self.node.prev_sibling_element().filter(|_| self.step())?;
        Some(Self {
            node,
            steps: self.steps,
        })
    }

    fn has_local_name(&self, name: &str) -> bool {
        self.step();
        self.node.tag_name().name() == name
    }

    fn attribute_matches(&self, name: &str, operator: AttributeOperator<'_>) -> bool {
        self.step();
        marked::attribute_matches(self.node, name, operator)
    }

    fn pseudo_class_matches(&self, class: PseudoClass<'_>) -> bool {
        class == PseudoClass::FirstChild && self.node.prev_sibling_element().is_none()
    }
}

/// What the last compound selector asks of an element. It is told to whoever is compared with it: the reader of styles keeps the
/// parts of selectors to itself.
#[derive(Debug, Default)]
struct Asked {
    id: Option<String>,
    class: Option<String>,
    name: Option<String>,
}

impl Asked {
    fn by(selector: &Selector<'_>) -> Self {
        let asked = RefCell::default();
        // Whoever says yes to everything is asked everything; without a parent it is asked nothing else.
        selector.matches(&Anything(&asked));
        asked.into_inner()
    }
}

/// An element that any compound selector matches, and that notes what it is asked.
struct Anything<'a>(&'a RefCell<Asked>);

impl Element for Anything<'_> {
    fn parent_element(&self) -> Option<Self> {
        None
    }

    fn prev_sibling_element(&self) -> Option<Self> {
        None
    }

    fn has_local_name(&self, name: &str) -> bool {
        self.0.borrow_mut().name = Some(name.to_owned());
        true
    }

    fn attribute_matches(&self, name: &str, operator: AttributeOperator<'_>) -> bool {
        let mut asked = self.0.borrow_mut();
        match (name, operator) {
            ("id", AttributeOperator::Matches(id)) => asked.id = Some(id.to_owned()),
            ("class", AttributeOperator::Contains(class)) => asked.class = Some(class.to_owned()),
            _ => {}
        }
        true
    }

    fn pseudo_class_matches(&self, _class: PseudoClass<'_>) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use arbtest::arbitrary::Unstructured;

    use super::*;

    /// A compound selector, or the attributes of an element.
    fn compound(u: &mut Unstructured<'_>) -> arbtest::arbitrary::Result<String> {
        let parts = [
            "*",
            "g",
            "a",
            ".x",
            ".y",
            ".x.y",
            "g.x",
            "#i",
            "#i.x",
            "a#j",
            "[class]",
            "[class='x y']",
            "[class~=y]",
            "[id=j]",
            "[id]",
            ":first-child",
            "a:first-child",
            "g[id='i'].y",
            ".y:hover",
        ];
        Ok((*u.choose(&parts)?).to_owned())
    }

    #[test]
    fn rules_that_are_found_are_those_that_match() {
        arbtest::arbtest(|u| {
            let mut css = String::new();
            for number in 0..u.int_in_range(1..=12)? {
                let mut selector = compound(u)?;
                for _ in 0..u.int_in_range(0..=2)? {
                    let combinator = *u.choose(&[" ", " > ", " + ", ", "])?;
                    selector = format!("{selector}{combinator}{}", compound(u)?);
                }
                css = format!("{css}{selector} {{ fill: #{number:03} }}\n");
            }
            let mut body = String::new();
            for _ in 0..u.int_in_range(1..=9)? {
                let attributes = [
                    "",
                    " class='x'",
                    " class='y x y'",
                    " class=' x  y '",
                    " id='i'",
                    " id='j' class='y'",
                    " class=''",
                    " id=''",
                ];
                let [name, attributes] = [*u.choose(&["g", "a"])?, *u.choose(&attributes)?];
                let element = format!("<{name}{attributes}>");
                body = match u.int_in_range(0..=2)? {
                    0 => format!("{body}{element}</{name}>"),
                    1 => format!("{element}</{name}>{body}"),
                    _ => format!("{element}{body}</{name}>"),
                };
            }
            let text = format!("<svg><style>{css}</style>{body}</svg>");
            let document = roxmltree::Document::parse(&text).expect("well-formed");
            let root = document.root_element();
            let rules = Rules::below(root).filter_map(|declarations| Some(declarations.first()?.value));
            let mut plain = StyleSheet::new();
            sheets::parse(&mut plain, &css);
            let steps = Cell::new(0);
            for node in root.descendants().filter(Node::is_element) {
                let found: Vec<&str> = rules.matching(node, &steps).copied().collect();
                let matching = plain
                    .rules
                    .iter()
                    .filter(|rule| rule.selector.matches(&Counted { node, steps: &steps }));
                let expected: Vec<&str> = matching.map(|rule| rule.declarations[0].value).collect();
                assert_eq!(found, expected, "{node:?} in {text}");
            }
            Ok(())
        })
        .budget_ms(500);
    }

    #[test]
    fn elements_are_compared_only_with_rules_that_may_be_theirs() {
        let rule = |i: usize| format!(".c{i}{{fill:red}} #i{i}{{fill:red}} n{i}{{fill:red}}");
        let css: String = (0..100).map(rule).collect();
        let text = format!("<svg><style>{css}</style><n1 class='c2 c3' id='i4'/></svg>");
        let document = roxmltree::Document::parse(&text).expect("well-formed");
        let rules = Rules::below(document.root_element());
        let steps = Cell::new(0);
        let shape = document.root_element().last_element_child().expect("a shape");
        assert_eq!(rules.matching(shape, &steps).count(), 4);
        assert_eq!((rules.len(), steps.get()), (300, 8), "each is found, and asked once");
    }
}
