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
    /// The twins whose elements are in place, and what each lies in; empty where they have to be put there.
    order: Vec<(NodeId, Option<usize>)>,
    focus: Option<NodeId>,
}

struct Shown {
    element: HtmlElement,
    twin: Twin,
}

impl Mirror {
    pub(super) fn new(document: Document, canvas: Element, container: Element) -> Self {
        Self { document, canvas, container, shown: HashMap::new(), order: Vec::new(), focus: None }
    }

    /// Makes the page show `twins`, with `focus` as the control that has the keyboard. Says whether it does: once `is_over`
    /// it ends, to go on with the next call. What has gone stays until what is new is put in place.
    pub(super) fn show(&mut self, twins: &[Twin], focus: NodeId, is_over: impl Fn() -> bool) -> Result<bool, JsValue> {
        let wanted: HashSet<NodeId> = twins.iter().map(|twin| twin.id).collect();
        for twin in twins {
            if self.update(twin)? && is_over() {
                return Ok(false);
            }
        }
        self.shown.retain(|id, shown| {
            let stays = wanted.contains(id);
            if !stays {
                shown.element.remove();
                // With what lay in it.
                self.order.clear();
            }
            stays
        });
        let order: Vec<_> = twins.iter().map(|twin| (twin.id, twin.parent)).collect();
        if order != self.order {
            self.put_in_place(twins)?;
            self.order = order;
        }

        let focus = wanted.contains(&focus).then_some(focus);
        if focus != self.focus {
            match focus {
                Some(id) => self.canvas.set_attribute("aria-activedescendant", &element_id(id))?,
                None => self.canvas.remove_attribute("aria-activedescendant")?,
            }
            self.focus = focus;
        }
        Ok(true)
    }

    /// Puts each element into its parent's, in the order of the twins.
    fn put_in_place(&mut self, twins: &[Twin]) -> Result<(), JsValue> {
        self.order.clear();
        let element = |twin: &Twin| self.shown.get(&twin.id).map(|shown| Element::from(shown.element.clone()));
        // The last child put in place in each parent; the container's comes last.
        let mut last: Vec<Option<Element>> = vec![None; twins.len() + 1];
        for (index, twin) in twins.iter().enumerate() {
            debug_assert!(twin.parent.is_none_or(|parent| parent < index), "parents come first");
            let Some(own) = element(twin) else { continue };
            let parent =
                twin.parent.and_then(|parent| element(&twins[parent])).unwrap_or_else(|| self.container.clone());
            let previous = &mut last[twin.parent.unwrap_or(twins.len())];
            let next = match previous {
                Some(previous) => previous.next_element_sibling(),
                None => parent.first_element_child(),
            };
            if next.as_ref() != Some(&own) {
                parent.insert_before(&own, next.as_deref())?;
            }
            *previous = Some(own);
        }
        Ok(())
    }

    /// Makes the element of one twin if it is new, and changes it where the twin has changed. Says whether it has.
    fn update(&mut self, twin: &Twin) -> Result<bool, JsValue> {
        let before = self.shown.get(&twin.id);
        if let Some(shown) = before
            && shown.twin == *twin
        {
            return Ok(false);
        }
        let element = match before {
            Some(shown) => shown.element.clone(),
            None => {
                self.order.clear();
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
            if element.first_element_child().is_some() {
                // A text takes the place of all that is in an element.
                self.order.clear();
            }
            element.set_text_content(twin.text.as_deref());
        }
        if old.is_none_or(|old| old.place != twin.place) {
            // Without a place it still counts for assistive tools, as a group around its children.
            let [left, top, width, height] = twin.place.unwrap_or_default();
            let place = format!("left: {left:.2}px; top: {top:.2}px; width: {width:.2}px; height: {height:.2}px");
            element.style().set_css_text(&place);
        }
        self.shown.insert(twin.id, Shown { element: element.clone(), twin: twin.clone() });
        Ok(true)
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
