import { useCallback, useMemo } from 'react';
import { createPortal } from 'react-dom';
import { AudienceScreen } from '../audience/AudienceScreen';
import type { Lights, LightsAt } from '../audience/drawing';
import { useWakeLock } from '../audience/useWakeLock';
import { useStore } from '../base/store';
import { useKeys } from '../parts/useKeys';
import type { Scene } from '../stage/scene';
import { useEditing } from './context';
import type { Editing } from './editing';
import { rememberScene } from './rememberScene';

/** Shows the preview as the audience sees the show, in the whole window, and lets it run. */
export function showAudience({ audience, preview }: Editing) {
  if (!preview.running.get()) preview.toggle();
  audience.set(true);
}

/** The audience view over the editor, if it is open, and the key that opens it. */
export function AudiencePreview() {
  const editing = useEditing();
  const isShown = useStore(editing.audience);
  useKeys([['a', () => showAudience(editing)]]);
  return isShown ? <Covering editing={editing} /> : null;
}

function Covering({ editing }: { editing: Editing }) {
  const { audience, preview } = editing;
  const lightsAt = useMemo(() => lightsOf(editing), [editing]);
  const back = useCallback(() => audience.set(false), [audience]);
  useWakeLock(useStore(preview.running));
  // Outside of the stage, whose style sheet places every canvas in it.
  return createPortal(
    <AudienceScreen role="dialog" lightsAt={lightsAt} onBack={back} onSpace={preview.toggle} />,
    document.body,
  );
}

/** The filled lights of the editor's stage. */
function lightsOf(editing: Editing): LightsAt {
  const sceneAt = rememberScene(editing);
  let last: (Lights & { scene: Scene }) | null = null;
  return (now_ms) => {
    const scene = sceneAt(now_ms);
    if (last?.scene !== scene) last = { scene, dots: scene.filled, floor: scene };
    return last;
  };
}
