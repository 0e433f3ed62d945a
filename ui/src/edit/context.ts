import type { EditorState } from '../model/editorState';
import { createContext, useContext } from 'react';
import { useStore } from '../base/store';
import type { Editing } from './editing';
import { settledOf } from './settled';

export const EditingContext = createContext<Editing | null>(null);

export function useEditing(): Editing {
  const editing = useContext(EditingContext);
  if (!editing) throw new Error('Nothing is being edited around this component.');
  return editing;
}

/** Part of the editor's state between gestures; `select` must give the same object for the same state. */
export const useEditor = <S>(select: (state: EditorState) => S): S =>
  useStore(settledOf(useEditing().editor), select);

/** Part of the editor's state also during gestures: for components that follow a drag. */
export const useEditorNow = <S>(select: (state: EditorState) => S): S =>
  useStore(useEditing().editor.state, select);
