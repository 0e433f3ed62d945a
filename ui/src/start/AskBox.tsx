import { Button, FileButton, TextInput, Title } from '@mantine/core';
import { IconChevronRight, IconPhoto, IconPlus } from '@tabler/icons-react';
import { useState, type FormEvent } from 'react';
import { welcomeFor, wordShow, type TemplateFrame } from '../make/templates';
import { useSession } from '../session/session';
import { beginEmpty, beginWithFiles, type Fleet } from './begin';
import { useWords } from './useWords';
import { WordFloor } from './WordFloor';
import { WordVerdict } from './WordVerdict';
import styles from './Start.module.css';

/** Longest text that can be typed, characters. */
const TEXT_MAX = 60;

interface Props {
  fleet: Fleet;
  /** The fleet in a few words. */
  about: string;
  isBusy: boolean;
  onWords: (text: string, frames: readonly TemplateFrame[]) => void;
}

/** Asks what a new show shows: words, with a picture of how the robots show them, files, or nothing yet. */
export function AskBox({ fleet, about, isBusy, onWords }: Props) {
  const session = useSession();
  const [text, setText] = useState(() => welcomeFor(fleet.robots));
  const words = useWords(text, fleet);
  const wanted = text.trim();
  const submit = (event: FormEvent) => {
    event.preventDefault();
    if (wanted !== '') onWords(wanted, wordShow(wanted));
  };
  return (
    <section className={styles.ask} aria-labelledby="ask">
      <form className={styles.question} onSubmit={submit}>
        <Title order={1} id="ask">
          What do you want to show?
        </Title>
        <div className={styles.idea}>
          <TextInput
            aria-label="Words to show"
            size="lg"
            placeholder="Type a word, or drop a picture anywhere"
            autoComplete="off"
            spellCheck={false}
            maxLength={TEXT_MAX}
            value={text}
            onChange={(event) => setText(event.currentTarget.value)}
            onFocus={(event) => event.currentTarget.select()}
            autoFocus
          />
          <Button
            type="submit"
            size="lg"
            disabled={wanted === '' || isBusy}
            rightSection={<IconChevronRight size={18} />}
          >
            Make this show
          </Button>
        </div>
        <div className={styles.others}>
          <span className="quiet">or</span>
          <FileButton
            multiple
            accept="image/*,.svg,.csv"
            onChange={(files) => {
              if (files.length > 0) void beginWithFiles(session, fleet, files);
            }}
            inputProps={{ 'aria-label': 'Files to show' }}
          >
            {(props) => (
              <Button
                variant="subtle"
                color="gray"
                leftSection={<IconPhoto size={18} />}
                disabled={isBusy}
                {...props}
              >
                Picture, SVG or animation…
              </Button>
            )}
          </FileButton>
          <Button
            variant="subtle"
            color="gray"
            leftSection={<IconPlus size={18} />}
            disabled={isBusy}
            onClick={() => void beginEmpty(session, fleet)}
          >
            Empty show
          </Button>
        </div>
        <WordVerdict made={words} robots={fleet.robots} />
      </form>
      <WordFloor made={words} stage={fleet.stage} about={about} />
    </section>
  );
}
