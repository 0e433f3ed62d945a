import { useState } from 'react';
import { Bottom } from '../parts/Bottom';
import { FailureNote } from './FailureNote';
import { FitNote } from './FitNote';
import { FleetSide } from './FleetSide';
import { FrameStrip } from './FrameStrip';
import { GoNote } from './GoNote';
import { GoOnNote } from './GoOnNote';
import { useLiveLight } from './light/useLiveLight';
import { JumpDialog } from './JumpDialog';
import { LiveStage } from './LiveStage';
import { PlaylistNote } from './PlaylistNote';
import { RunNote } from './RunNote';
import { StartDialog } from './StartDialog';
import { StoppedNote } from './StoppedNote';
import { Transport } from './Transport';
import { Gate } from '../parts/Gate';
import { RunsDialog } from '../parts/RunsDialog';
import styles from '../parts/page.module.css';

/** The page of the live view. */
export function LivePage() {
  const [past, setPast] = useState(false);
  const showPast = () => setPast(true);
  const liveLight = useLiveLight();
  return (
    <main className={styles.page}>
      <LiveStage />
      <Bottom label="Playing">
        <Gate needs="operator" act="go on">
          <FailureNote />
          <StoppedNote />
        </Gate>
        <PlaylistNote />
        <RunNote onPast={showPast} />
        <Gate needs="operator" act="go on or give GO">
          <GoOnNote />
          <GoNote />
        </Gate>
        <Gate needs="editor" act="change shows">
          <FitNote />
        </Gate>
        <Transport />
        <FrameStrip />
      </Bottom>
      <FleetSide liveLight={liveLight} onPast={showPast} />
      <JumpDialog />
      <StartDialog />
      {past ? <RunsDialog onClose={() => setPast(false)} /> : null}
    </main>
  );
}
