import { MantineProvider } from '@mantine/core';
import { Notifications } from '@mantine/notifications';
import '@mantine/notifications/styles.css';
import { useState } from 'react';
import { EditPage } from './edit/EditPage';
import { LivePage } from './live/LivePage';
import { DraftBanner } from './shell/DraftBanner';
import { DropFile } from './shell/DropFile';
import { Header } from './shell/Header';
import { LinkBanner } from './shell/LinkBanner';
import { OfferDialog } from './shell/OfferDialog';
import { OpenBanner } from './shell/OpenBanner';
import { createSession, SessionContext } from './session/session';
import { useView } from './session/useHash';
import { mantineVariables, theme } from './theme';
import styles from './App.module.css';

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
        <Notifications className="notices" position="bottom-left" limit={4} />
        <div className={styles.app}>
          <div>
            <Header view={view} />
            <OpenBanner />
            <LinkBanner />
            <DraftBanner />
          </div>
          {view === 'edit' ? <EditPage /> : <LivePage />}
        </div>
        <OfferDialog />
        <DropFile />
      </SessionContext>
    </MantineProvider>
  );
}
