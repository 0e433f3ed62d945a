import { useEffect, useRef, type ReactNode } from 'react';
import { useStore } from '../base/store';
import { drawLights, type LightsAt } from './drawing';
import { useAudienceKeys } from './useAudienceKeys';
import { usePointerRest } from './usePointerRest';
import { turnViewpoint, viewpointStore } from './viewpoint';
import styles from './Audience.module.css';

interface Props {
  /** `dialog`: the screen lies over another page, and takes Tab and its own keys from it. */
  role: 'main' | 'dialog';
  lightsAt: LightsAt;
  onBack: () => void;
  /** What Space does; null: nothing. */
  onSpace?: (() => void) | null;
  children?: ReactNode;
}

/** Lights on black in the whole window, with a line of keys while the pointer moves. */
export function AudienceScreen({ role, lightsAt, onBack, onSpace = null, children }: Props) {
  const root = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const rest = usePointerRest();
  const viewpoint = useStore(viewpointStore);
  useAudienceKeys(onBack, onSpace, role === 'dialog');
  useEffect(() => (canvas.current ? drawLights(canvas.current, lightsAt) : undefined), [lightsAt]);
  useEffect(() => {
    // Takes the focus, so that Space does not press the button that opened this, and gives it back at the end.
    const before = document.activeElement;
    root.current?.focus();
    return () => (before instanceof HTMLElement ? before.focus() : undefined);
  }, []);
  return (
    <div
      ref={root}
      className={styles.screen}
      role={role}
      aria-modal={role === 'dialog' || undefined}
      aria-label="Audience view"
      tabIndex={-1}
      data-pointer={rest}
      data-viewpoint={viewpoint}
      onDoubleClick={turnViewpoint}
    >
      <canvas ref={canvas} role="img" aria-label="The lights of the robots" />
      {rest === 'away' ? null : (
        <p className={styles.keys}>
          <kbd>F</kbd> full screen · <kbd>P</kbd> perspective · <kbd>Esc</kbd> back
        </p>
      )}
      {children}
    </div>
  );
}
