//! Keeps the page's elements equal to a list of twins, touching only what has changed.

use std::collections::{HashMap, HashSet};

use egui::accesskit::NodeId;
use wasm_bindgen::JsCast as _;
use wasm_bindgen::JsValue;
use web_sys::{Document, Element, HtmlElement};

use super::tree::Twin;

/// The elements over the canvas, one for each twin.
pub(super) struct Mirror {
    document: Document,
    canvas: Element,
    container: Element,
    shown: HashMap<NodeId, Shown>,
    focus: Option<NodeId>,
}

struct Shown {
    element: HtmlElement,
    twin: Twin,
}

impl Mirror {
    pub(super) fn new(document: Document, canvas: Element, container: Element) -> Self {
        Self { document, canvas, container, shown: HashMap::new(), focus: None }
    }

    /// Makes the page show `twins`, with `focus` as the control that has the keyboard.
    pub(super) fn show(&mut self, twins: &[Twin], focus: NodeId) -> Result<(), JsValue> {
        let wanted: HashSet<NodeId> = twins.iter().map(|twin| twin.id).collect();
        self.shown.retain(|id, shown| {
            let stays = wanted.contains(id);
            if !stays {
                shown.element.remove();
            }
            stays
        });

        // The last child put in place in each parent; the container's comes last.
        let mut last: Vec<Option<Element>> = vec![None; twins.len() + 1];
        for (index, twin) in twins.iter().enumerate() {
            let element = self.update(twin)?;
            let parent = match twin.parent.and_then(|parent| self.shown.get(&twins[parent].id)) {
                Some(shown) => Element::from(shown.element.clone()),
                None => self.container.clone(),
            };
            let previous = &mut last[twin.parent.unwrap_or(twins.len())];
            let next = match previous {
                Some(previous) => previous.next_element_sibling(),
                None => parent.first_element_child(),
            };
            if next.as_ref() != Some(&element) {
                parent.insert_before(&element, next.as_deref())?;
            }
            *previous = Some(element);
            debug_assert!(twin.parent.is_none_or(|parent| parent < index), "parents come first");
        }

        let focus = wanted.contains(&focus).then_some(focus);
        if focus != self.focus {
            match focus {
                Some(id) => self.canvas.set_attribute("aria-activedescendant", &element_id(id))?,
                None => self.canvas.remove_attribute("aria-activedescendant")?,
            }
            self.focus = focus;
        }
        Ok(())
    }

    /// The element of one twin, made if it is new and changed where the twin has changed.
    fn update(&mut self, twin: &Twin) -> Result<Element, JsValue> {
        let before = self.shown.get(&twin.id);
        if let Some(shown) = before
            && shown.twin == *twin
        {
            return Ok(shown.element.clone().into());
        }
        let element = match before {
            Some(shown) => shown.element.clone(),
            None => {
                let element: HtmlElement = self.document.create_element("div")?.unchecked_into();
                element.set_id(&element_id(twin.id));
                element.set_tab_index(-1);
                element
            }
        };
        let old = before.map(|shown| &shown.twin);

        let old_attributes = old.map_or(&[][..], |old| &old.attributes);
        for (key, value) in &twin.attributes {
            if !old_attributes.iter().any(|(k, v)| k == key && v == value) {
                element.set_attribute(key, value)?;
            }
        }
        for (key, _) in old_attributes {
            if !twin.attributes.iter().any(|(k, _)| k == key) {
                element.remove_attribute(key)?;
            }
        }
        let old_text = old.and_then(|old| old.text.as_deref());
        if old_text != twin.text.as_deref() {
            element.set_text_content(twin.text.as_deref());
        }
        if old.is_none_or(|old| old.place != twin.place) {
            // Without a place it still counts for assistive tools, as a group around its children.
            let place = twin.place.unwrap_or_default();
            for (property, pixels) in ["left", "top", "width", "height"].into_iter().zip(place) {
                element.style().set_property(property, &format!("{pixels:.2}px"))?;
            }
        }
        self.shown.insert(twin.id, Shown { element: element.clone(), twin: twin.clone() });
        Ok(element.into())
    }
}

const PREFIX: &str = "twin-";

fn element_id(id: NodeId) -> String {
    format!("{PREFIX}{}", id.0)
}

/// The node an element is the twin of.
pub(super) fn node_of(element: &Element) -> Option<NodeId> {
    element.id().strip_prefix(PREFIX)?.parse().ok().map(NodeId)
}
