import { useEffect, useMemo } from 'react';
import { useStore } from '../base/store';
import { StageCanvas } from '../stage/StageCanvas';
import { AudiencePreview } from './AudiencePreview';
import { useEditing } from './context';
import { PixelTwin } from './PixelTwin';
import { EmptyFrame } from './EmptyFrame';
import { StageMenu } from './StageMenu';
import { StageHint } from './StageHint';
import { StageTools } from './StageTools';
import { usePreviewSound } from './music/usePreviewSound';
import { rememberScene, unlessCovered } from './rememberScene';
import { usePreview } from './usePreview';
import { useHand } from './useHand';
import { stopAdding } from '../make/pen';
import { useKeys } from '../parts/useKeys';
import styles from '../stage/stage.module.css';

/** The floor of the editor. */
export function EditStage() {
  const editing = useEditing();
  const { hand, giveUp } = useHand(editing);
  const sceneAt = useMemo(() => unlessCovered(editing, rememberScene(editing)), [editing]);
  const tool = useStore(editing.tool);
  const isHeld = useStore(editing.space.held);
  const routes = useStore(editing.options, (options) => options.routes);
  const { full } = editing;
  useEffect(() => (routes ? full.follow() : undefined), [routes, full]);
  usePreview(editing);
  usePreviewSound(editing);
  useKeys([
    [
      'Escape',
      (event) => {
        // A drag was given up: the key must not also close the Make panel.
        if (giveUp()) {
          event.stopImmediatePropagation();
          return;
        }
        const making = editing.making.get();
        if (making) {
          if (stopAdding(making)) event.stopImmediatePropagation();
          return;
        }
        if (editing.tool.get() !== 'arrow') editing.tool.set('arrow');
        else editing.editor.select([]);
        editing.preview.stop();
      },
    ],
  ]);
  return (
    <section
      className={styles.stage}
      aria-label="The floor"
      data-tool={isHeld ? 'hand' : tool}
      data-testid="stage"
    >
      <StageCanvas view={editing.view} sceneAt={sceneAt} pans={editing.space} hand={hand} />
      <StageTools />
      <StageMenu />
      <StageHint />
      <EmptyFrame />
      <PixelTwin />
      <AudiencePreview />
    </section>
  );
}
