import { useEffect } from 'react';
import { useStore } from '../base/store';
import { useSession } from '../session/session';
import { useEditing } from './context';
import { takeAnything } from './taking';

/** Media type that marks a copy of pixels in the clipboard. */
const PIXELS = 'application/x-lightbots-pixels';

/** Takes what is dropped on the page or pasted, and copies and pastes pixels. */
export function Taking() {
  const session = useSession();
  const editing = useEditing();
  const dropped = useStore(session.dropped);
  useEffect(() => {
    // The editor may still have another show than the one for which this was dropped.
    if (!dropped || (dropped.into !== null && dropped.into !== editing.name)) return;
    session.dropped.set(null);
    void takeAnything(session, editing, dropped.files, dropped.text);
  }, [session, editing, dropped]);
  useEffect(() => {
    const copy = (event: ClipboardEvent) => {
      if (isElsewhere(event) || editing.editor.copy() === 0) return;
      event.clipboardData?.setData(PIXELS, 'copied');
      event.preventDefault();
    };
    const paste = (event: ClipboardEvent) => {
      const data = event.clipboardData;
      const files = [...(data?.files ?? [])];
      // A field takes text for itself, but no files.
      if (!data || isElsewhere(event, files.length > 0)) return;
      event.preventDefault();
      if (data.types.includes(PIXELS)) {
        if (!editing.making.get()) editing.editor.paste();
      } else void takeAnything(session, editing, files, data.getData('text/plain'));
    };
    document.addEventListener('copy', copy);
    document.addEventListener('paste', paste);
    return () => {
      document.removeEventListener('copy', copy);
      document.removeEventListener('paste', paste);
    };
  }, [session, editing]);
  return null;
}

/** Whether a copy or paste belongs to a dialog, a field or marked text. */
function isElsewhere({ target, type }: ClipboardEvent, isFile = false): boolean {
  if (document.querySelector('[role="dialog"]')) return true;
  const field = target instanceof HTMLInputElement || target instanceof HTMLTextAreaElement;
  if (field) return !isFile && !['file', 'radio', 'checkbox', 'button'].includes(target.type);
  return type === 'copy' && document.getSelection()?.isCollapsed === false;
}
