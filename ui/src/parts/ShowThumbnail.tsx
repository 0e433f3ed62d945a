import { useEffect, useRef, useState } from 'react';
import { readShow } from '../model/json';
import { middleFrame, type Frame, type Stage } from '../model/show';
import { Thumbnail } from '../stage/Thumbnail';
import styles from './ShowThumbnail.module.css';

interface Picture {
  frame: Frame;
  stage: Stage;
}

interface Props {
  /** Identifies the show and its version; the same text has the same picture. */
  version: string;
  /** Fetches the show's document. */
  load: () => Promise<unknown>;
}

/** Pictures by version, kept for the next time. */
const pictures = new Map<string, Picture>();
/** Most pictures that are kept; above that all are dropped, because a picture takes a few hundred bytes per pixel. */
const PICTURES_MAX = 100;

async function pictureOf(load: () => Promise<unknown>): Promise<Picture | null> {
  const show = readShow(await load());
  const frame = middleFrame(show);
  return frame ? { frame, stage: show.stage } : null;
}

/** Picture of a show (its middle frame), fetched when it scrolls into view; empty until then, and if that fails. */
export function ShowThumbnail({ version, load }: Props) {
  const [picture, setPicture] = useState(pictures.get(version) ?? null);
  const fetching = useRef(load);
  const place = useRef<HTMLSpanElement>(null);
  useEffect(() => {
    const element = place.current;
    if (!element || pictures.has(version)) return;
    let wanted = true;
    const observer = new IntersectionObserver((seen) => {
      if (!seen.some((s) => s.isIntersecting)) return;
      observer.disconnect();
      pictureOf(fetching.current).then(
        (found) => {
          if (!found || !wanted) return;
          if (pictures.size >= PICTURES_MAX) pictures.clear();
          pictures.set(version, found);
          setPicture(found);
        },
        () => undefined,
      );
    });
    observer.observe(element);
    return () => {
      wanted = false;
      observer.disconnect();
    };
  }, [version]);
  return (
    <span className={styles.picture} data-testid="entry-picture" ref={place}>
      {picture ? <Thumbnail frame={picture.frame} stage={picture.stage} /> : null}
    </span>
  );
}
