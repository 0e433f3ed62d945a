import { Bottom } from '../parts/Bottom';
import { FailureNote } from './FailureNote';
import { FitNote } from './FitNote';
import { FleetSide } from './FleetSide';
import { FrameStrip } from './FrameStrip';
import { GoNote } from './GoNote';
import { GoOnNote } from './GoOnNote';
import { LiveStage } from './LiveStage';
import { StartDialog } from './StartDialog';
import { StoppedNote } from './StoppedNote';
import { Transport } from './Transport';
import styles from '../parts/page.module.css';

/** The page of the live view. */
export function LivePage() {
  return (
    <main className={styles.page}>
      <LiveStage />
      <Bottom label="Playing">
        <FailureNote />
        <StoppedNote />
        <GoOnNote />
        <GoNote />
        <FitNote />
        <Transport />
        <FrameStrip />
      </Bottom>
      <FleetSide />
      <StartDialog />
    </main>
  );
}
