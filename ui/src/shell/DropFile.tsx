import { useEffect, useState } from 'react';
import { DROPPABLE } from '../session/droppable';
import { takeDropped } from '../session/takeDropped';
import { useSession, type Session } from '../session/session';
import styles from './DropFile.module.css';

/** Takes what is dropped anywhere on the page; during the drag, says what a drop will do. */
export function DropFile() {
  const session = useSession();
  const [over, setOver] = useState<string | null>(null);
  useEffect(() => listen(session, setOver), [session]);
  return over === null ? null : (
    <div className={styles.veil} data-testid="veil">
      <div>
        <b>{over}</b>
        <p>You can drop {DROPPABLE}.</p>
      </div>
    </div>
  );
}

/** Follows drags from outside of the page; returns a function that ends this. */
function listen(session: Session, setOver: (words: string | null) => void): () => void {
  let depth = 0;
  /** Whether something of the page itself is dragged, such as a frame of the strip. */
  let isOwn = false;
  const isForeign = ({ dataTransfer: data, target }: DragEvent) =>
    !isOwn &&
    data !== null &&
    // A field takes text for itself.
    (data.types.includes('Files') || (data.types.includes('text/plain') && !isField(target)));
  const end = () => {
    depth = 0;
    setOver(null);
  };
  const listeners: { [name: string]: (event: DragEvent) => void } = {
    dragstart: () => void (isOwn = true),
    dragend: () => void (isOwn = false),
    dragenter(event) {
      if (!isForeign(event)) return;
      depth++;
      setOver(wordsOf(event.dataTransfer));
    },
    dragleave(event) {
      if (isForeign(event) && --depth <= 0) end();
    },
    dragover(event) {
      if (isForeign(event)) event.preventDefault();
    },
    drop(event) {
      if (!isForeign(event)) return;
      event.preventDefault();
      end();
      const files = [...(event.dataTransfer?.files ?? [])];
      const text = event.dataTransfer?.getData('text/plain') ?? '';
      if (files.length > 0 || text.trim() !== '') void takeDropped(session, { files, text });
    },
  };
  const entries = Object.entries(listeners) as [string, EventListener][];
  for (const [name, listener] of entries) window.addEventListener(name, listener);
  return () => {
    for (const [name, listener] of entries) window.removeEventListener(name, listener);
  };
}

const isField = (target: EventTarget | null) =>
  target instanceof HTMLInputElement || target instanceof HTMLTextAreaElement;

/** What a drop will do, in words. Before the drop, browsers tell the types of files, but not their names. */
function wordsOf(data: DataTransfer | null): string {
  const items = [...(data?.items ?? [])];
  const types = items.filter(({ kind }) => kind === 'file').map(({ type }) => type);
  if (items.length > 0 && types.length === 0) return 'Drop the words to make the frame from them';
  if (types.length > 1) return 'Drop the files to make a frame from each';
  const [type = ''] = types;
  if (type === 'application/json' || type.includes('zip')) return 'Drop the show to open it';
  if (type.startsWith('image/')) return 'Drop the picture to make the frame from it';
  if (type.startsWith('text/')) return 'Drop the list to make the frame from it';
  if (type.startsWith('font/')) return 'Drop the font to set words in it';
  return 'Drop it to make the frame from it, or to open a show';
}
