//! Facts of a figure in one of its states: the numbers, texts and settings that a page prints,
//! quotes and checks, from the same snapshot as in a browser.

use super::figures::Aspect;
use crate::problems::name_list;
use serde_json::Value;

/// Facts of a figure in one state, from its snapshot.
#[derive(Debug, Clone)]
pub struct Facts(Value);

/// Value of a readout, a control or a goal as shown to readers.
#[derive(Debug, Clone, PartialEq)]
pub struct Shown {
    /// Text, with its unit.
    pub text: String,
    /// Number, if it is one.
    pub number: Option<f64>,
}

impl Facts {
    /// Parses a snapshot.
    ///
    /// # Errors
    /// A message, if the text is not JSON.
    pub fn parse(snapshot: &str) -> Result<Facts, String> {
        serde_json::from_str(snapshot)
            .map(Facts)
            .map_err(|error| format!("the snapshot cannot be read: {error}"))
    }

    /// Returns the snapshot itself.
    pub fn snapshot(&self) -> &Value {
        &self.0
    }

    /// Returns the description of the picture, in one or two sentences.
    pub fn description(&self) -> &str {
        self.0["description"].as_str().unwrap_or_default()
    }

    /// Returns the shape of its picture.
    pub fn aspect(&self) -> Aspect {
        match self.0["aspect"].as_str() {
            Some("broad") => Aspect::Broad,
            _ => Aspect::Tall,
        }
    }

    /// Returns the names in a list of the snapshot: `controls`, `readouts`, `challenges`.
    pub fn ids(&self, list: &str) -> Vec<&str> {
        let entries = self.0[list].as_array();
        let ids = entries.into_iter().flatten();
        ids.filter_map(|entry| entry["id"].as_str()).collect()
    }

    /// Checks names, separated by white space, against a list of the snapshot.
    ///
    /// # Errors
    /// A message with the names that exist.
    pub fn check_names(&self, list: &str, names: &str) -> Result<(), String> {
        let known = self.ids(list);
        match names.split_whitespace().find(|name| !known.contains(name)) {
            None => Ok(()),
            Some(name) => {
                let known = name_list(&known);
                Err(format!(
                    "none of its {list} is called \"{name}\"; {list}: {known}"
                ))
            }
        }
    }

    /// Returns the value of a name: a readout, else the value of a control, else, as `goal.name`,
    /// whether a goal is reached.
    ///
    /// # Errors
    /// A message with the names that exist.
    pub fn shown(&self, id: &str) -> Result<Shown, String> {
        if let Some(readout) = self.entry("readouts", id) {
            let text = readout["text"].as_str().unwrap_or_default().to_owned();
            let number = readout["value"].as_f64();
            return Ok(Shown { text, number });
        }
        if let Some(control) = self.entry("controls", id) {
            let text = control["value_text"].as_str().unwrap_or_default();
            let text = text.to_owned();
            let number = control["value"].as_f64();
            return Ok(Shown { text, number });
        }
        let goal = id.strip_prefix("goal.");
        if let Some(goal) = goal.and_then(|goal| self.entry("challenges", goal)) {
            let text = goal["solved"].to_string();
            return Ok(Shown { text, number: None });
        }
        let goals = self.ids("challenges").into_iter();
        let goals: Vec<String> = goals.map(|goal| format!("goal.{goal}")).collect();
        let mut known = [self.ids("readouts"), self.ids("controls")].concat();
        known.extend(goals.iter().map(String::as_str));
        let known = name_list(&known);
        Err(format!(
            "it shows nothing called \"{id}\"; it shows {known}"
        ))
    }

    fn entry(&self, list: &str, id: &str) -> Option<&Value> {
        self.0[list]
            .as_array()?
            .iter()
            .find(|entry| entry["id"] == id)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A figure with a number, a text, a slider and a goal.
    pub(crate) fn some_facts() -> Facts {
        Facts::parse(
            r#"{"aspect":"broad","description":"D.",
            "readouts":[{"id":"off","text":"2.3 px","value":2.345},
                        {"id":"best","text":"36 of 60","value":"36 of 60"},
                        {"id":"condition","text":"1.5·10⁵","value":"1.5·10⁵"}],
            "controls":[{"id":"size","kind":"slider","value":0.5,"value_text":"0.50 m"}],
            "challenges":[{"id":"reach","solved":false}]}"#,
        )
        .unwrap()
    }

    #[test]
    fn names_lead_to_what_is_shown() {
        let facts = some_facts();
        let (text, number) = ("2.3 px".to_owned(), Some(2.345));
        assert_eq!(facts.shown("off"), Ok(Shown { text, number }));
        assert_eq!(facts.shown("size").unwrap().text, "0.50 m");
        assert_eq!(facts.shown("goal.reach").unwrap().text, "false");
        let sentence = facts.shown("of").unwrap_err();
        assert!(
            sentence.contains("\"of\"; it shows off, best"),
            "{sentence}"
        );
        assert_eq!(facts.aspect(), Aspect::Broad);
        assert_eq!(facts.check_names("controls", "size"), Ok(()));
        let sentence = facts.check_names("readouts", "off offf").unwrap_err();
        assert!(
            sentence.contains("called \"offf\"; readouts: off"),
            "{sentence}"
        );
    }
}
