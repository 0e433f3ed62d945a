import type { EditorState } from '../model/editorState';
import { createStore, type Store } from '../base/store';
import type { Editor } from '../model/editor';

const kept = new WeakMap<Editor, Store<EditorState>>();

/**
 * The editor's state without the changes of a gesture that is under way: panels, strip and thumbnails need only what a
 * gesture ends in. The same store for the same editor.
 */
export function settledOf(editor: Editor): Store<EditorState> {
  let settled = kept.get(editor);
  if (!settled) {
    const store = createStore(editor.state.get());
    editor.state.subscribe(() => {
      if (!editor.isGesturing()) store.set(editor.state.get());
    });
    kept.set(editor, store);
    settled = store;
  }
  return settled;
}
