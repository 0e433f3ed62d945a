import type { EditorState } from '../model/editorState';
import { createStore, type Store } from '../base/store';
import type { Editor } from '../model/editor';

const kept = new WeakMap<Editor, Store<EditorState>>();

/**
 * The editor's state between gestures. The stage follows a drag sixty times a second; panels, strip and thumbnails need
 * only what it ends in.
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
