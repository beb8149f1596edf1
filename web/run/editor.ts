/** The editor: CodeMirror in a shadow root, where its styles comply with the page's Content-Security-Policy. */

import { acceptCompletion, autocompletion, closeBrackets, completionKeymap, type CompletionContext } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap } from "@codemirror/commands";
import { javascript } from "@codemirror/lang-javascript";
import { HighlightStyle, bracketMatching, indentOnInput, indentUnit, syntaxHighlighting, syntaxTree } from "@codemirror/language";
import { EditorState, StateEffect, StateField } from "@codemirror/state";
import { Decoration, EditorView, hoverTooltip, keymap, lineNumbers, type DecorationSet } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import type { Name } from "./names.js";

/** Colors of listings. */
const COLORS = HighlightStyle.define([
  { tag: tags.comment, color: "var(--muted)", fontStyle: "italic" },
  { tag: [tags.keyword, tags.bool, tags.null], color: "var(--code-keyword)", fontWeight: "600" },
  { tag: [tags.string, tags.special(tags.string)], color: "var(--code-string)" },
  { tag: tags.number, color: "var(--code-number)" },
  { tag: [tags.function(tags.variableName), tags.function(tags.propertyName)], color: "var(--code-call)" },
]);

const LOOK = EditorView.theme({
  "&": { color: "var(--ink)", backgroundColor: "transparent", fontSize: "var(--code-size)" },
  "&.cm-focused": { outline: "2px solid var(--accent)", outlineOffset: "-2px" },
  ".cm-scroller": { fontFamily: "var(--mono)", lineHeight: "1.6" },
  ".cm-content": { padding: "0.9rem 0", caretColor: "var(--ink)" },
  ".cm-gutters": { color: "var(--muted)", backgroundColor: "var(--surface)", border: "0" },
  ".cm-lineNumbers .cm-gutterElement": { minWidth: "2.2em" },
  ".cm-faulty": { backgroundColor: "color-mix(in srgb, var(--bad) 18%, transparent)" },
  ".cm-matchingBracket": { backgroundColor: "var(--accent-soft)", outline: "1px solid var(--edge)" },
  ".cm-tooltip": { color: "var(--ink)", backgroundColor: "var(--paper)", border: "1px solid var(--edge)", maxWidth: "min(40rem, 90vw)" },
  ".cm-tooltip-autocomplete > ul > li[aria-selected]": { color: "var(--ink)", backgroundColor: "var(--accent-soft)" },
  ".cm-hint": { padding: "0.5rem 0.7rem", fontFamily: "var(--sans)", fontSize: "0.875rem", lineHeight: "1.45" },
  ".cm-hint code": { display: "block", fontFamily: "var(--mono)", fontSize: "0.8125rem", overflowWrap: "anywhere" },
});

const setFaulty = StateEffect.define<number | undefined>();
const faulty = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(marks, { effects, docChanged, state }) {
    for (const effect of effects) {
      if (!effect.is(setFaulty)) continue;
      const line = effect.value;
      if (line === undefined || line > state.doc.lines) return Decoration.none;
      return Decoration.set(Decoration.line({ class: "cm-faulty" }).range(state.doc.line(line).from));
    }
    return docChanged ? Decoration.none : marks;
  },
  provide: (field) => EditorView.decorations.from(field),
});

/** Callbacks of an editor. */
export interface EditorListener {
  changed(code: string): void;
  /** Called on Ctrl+Enter or Cmd+Enter. */
  run(): void;
}

export class Editor {
  readonly #view: EditorView;

  /** Creates the editor in an empty element. */
  constructor(place: HTMLElement, label: string, code: string, names: () => Promise<Name[]>, listener: EditorListener) {
    const root = place.attachShadow({ mode: "open" });
    this.#view = new EditorView({
      root,
      parent: root,
      state: EditorState.create({
        doc: code,
        extensions: [
          lineNumbers(),
          history(),
          indentUnit.of("  "),
          indentOnInput(),
          bracketMatching(),
          closeBrackets(),
          javascript(),
          syntaxHighlighting(COLORS),
          LOOK,
          faulty,
          autocompletion({ override: [(context) => complete(context, names)] }),
          hoverTooltip((view, at) => hint(view, at, names)),
          // Tab moves on to the buttons unless a completion is open.
          keymap.of([
            { key: "Mod-Enter", run: () => (listener.run(), true) },
            { key: "Tab", run: acceptCompletion },
            ...completionKeymap,
            ...historyKeymap,
            ...defaultKeymap,
          ]),
          EditorView.contentAttributes.of({ "aria-label": label }),
          EditorView.updateListener.of(({ docChanged }) => {
            if (docChanged) listener.changed(this.code);
          }),
        ],
      }),
    });
  }

  get code(): string {
    return this.#view.state.doc.toString();
  }

  set code(insert: string) {
    this.#view.dispatch({ changes: { from: 0, to: this.#view.state.doc.length, insert } });
  }

  /** Marks a line, counted from 1; none if undefined. */
  mark(line: number | undefined): void {
    this.#view.dispatch({ effects: setFaulty.of(line) });
  }

  /** Moves the cursor to a position, counted from 1. */
  goTo(line: number, column = 1): void {
    const { from, to } = this.#view.state.doc.line(Math.min(line, this.#view.state.doc.lines));
    this.#view.dispatch({ selection: { anchor: Math.min(from + column - 1, to) }, scrollIntoView: true });
    this.focus();
  }

  focus(): void {
    this.#view.focus();
  }
}

async function complete(context: CompletionContext, names: () => Promise<Name[]>) {
  const inside = syntaxTree(context.state).resolveInner(context.pos, -1).name;
  if (/String|Comment/.test(inside)) return null;
  const word = context.matchBefore(/\w*/);
  if (!word) return null;
  const isMember = context.state.sliceDoc(word.from - 1, word.from) === ".";
  if (word.from === word.to && !isMember && !context.explicit) return null;
  const fitting = (await names()).filter(({ isMethod }) => isMethod === isMember);
  const options = fitting.map(({ name, signature, docs }) => ({
    label: name,
    type: "function",
    info: () => explain(signature, docs),
  }));
  return options.length > 0 ? { from: word.from, options, validFor: /^\w*$/ } : null;
}

async function hint(view: EditorView, at: number, names: () => Promise<Name[]>) {
  const word = view.state.wordAt(at);
  if (!word) return null;
  const text = view.state.sliceDoc(word.from, word.to);
  const isMember = view.state.sliceDoc(word.from - 1, word.from) === ".";
  const known = (await names()).find(({ name, isMethod }) => name === text && isMethod === isMember);
  if (!known) return null;
  return { pos: word.from, end: word.to, above: true, create: () => ({ dom: explain(known.signature, known.docs) }) };
}

function explain(signature: string, docs: string): HTMLElement {
  const box = document.createElement("div");
  box.className = "cm-hint";
  const code = document.createElement("code");
  code.textContent = signature;
  box.append(code, docs);
  return box;
}
