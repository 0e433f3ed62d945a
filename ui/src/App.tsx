import { MantineProvider } from '@mantine/core';
import { Notifications } from '@mantine/notifications';
import '@mantine/notifications/styles.css';
import { lazy, Suspense, useState, type ReactNode } from 'react';
import { useStore } from './base/store';
import { EditPage } from './edit/EditPage';
import { LivePage } from './live/LivePage';
import { DraftBanner } from './shell/DraftBanner';
import { DropFile } from './shell/DropFile';
import { Header } from './shell/Header';
import { IncidentBanner } from './shell/IncidentBanner';
import { LinkBanner } from './shell/LinkBanner';
import { NotOpenBanner } from './shell/NotOpenBanner';
import { OfferDialog } from './shell/OfferDialog';
import { OpenBanner } from './shell/OpenBanner';
import { createSession, SessionContext, useSession } from './session/session';
import { useView, type View } from './session/address';
import { mantineVariables, theme } from './theme';
import styles from './App.module.css';

/** Loaded when it is first shown. */
const StartPage = lazy(() => import('./start/StartPage'));

const SharedPage = lazy(() => import('./start/SharedPage'));

/** Loaded when the audience view is first shown, often on a projector's computer. */
const AudiencePage = lazy(() => import('./audience/AudiencePage'));

const FitDialog = lazy(() => import('./fit/FitDialog'));

/** The dialog that fits the show to a number of robots, while `fitting` of the session says one. */
function Fitting() {
  const robots = useStore(useSession().fitting);
  return robots === null ? null : (
    <Suspense>
      <FitDialog robots={robots} />
    </Suspense>
  );
}

/** A view with the header above it: all but the audience view. */
type WorkView = Exclude<View, 'audience'>;

const PAGES: Record<WorkView, ReactNode> = {
  live: <LivePage />,
  edit: <EditPage />,
  new: (
    <Suspense fallback={<main aria-busy />}>
      <StartPage />
    </Suspense>
  ),
  shared: (
    <Suspense fallback={<main aria-busy />}>
      <SharedPage />
    </Suspense>
  ),
};

/** The header, banners, the view below them, and dialogs that any view may open. */
function Work({ view }: { view: WorkView }) {
  return (
    <>
      <div className={styles.app}>
        <div>
          <Header view={view} />
          <OpenBanner />
          <LinkBanner />
          <IncidentBanner view={view} />
          <DraftBanner />
          <NotOpenBanner view={view} />
        </div>
        {PAGES[view]}
      </div>
      <Fitting />
      <OfferDialog />
      <DropFile />
    </>
  );
}

export function App() {
  const [session] = useState(createSession);
  const view = useView();
  return (
    <MantineProvider
      theme={theme}
      cssVariablesResolver={mantineVariables}
      defaultColorScheme="auto"
    >
      <SessionContext value={session}>
        <Notifications className="notices" position="bottom-left" limit={4} zIndex={1002} />
        {view === 'audience' ? (
          <Suspense fallback={<main aria-busy />}>
            <AudiencePage />
          </Suspense>
        ) : (
          <Work view={view} />
        )}
      </SessionContext>
    </MantineProvider>
  );
}
