import { useEffect, useRef, useState } from 'react';
import { getShow } from '../api/http';
import type { ShowEntry } from '../api/types.gen';
import { readShow } from '../model/json';
import type { Frame, Stage } from '../model/show';
import { Thumbnail } from '../stage/Thumbnail';
import styles from './Library.module.css';

interface Picture {
  frame: Frame;
  stage: Stage;
}

/** Pictures by name and version; bounded, because a picture takes a few hundred bytes per pixel. */
const pictures = new Map<string, Picture>();
const PICTURES_MAX = 100;

/** The frame that represents a show: the middle one, because many shows begin and end in rows. */
async function pictureOf(name: string): Promise<Picture | null> {
  const show = readShow((await getShow(name)).document);
  const frame = show.frames[Math.floor(show.frames.length / 2)];
  return frame ? { frame, stage: show.stage } : null;
}

/** Picture of a show, fetched when it scrolls into view. */
export function ShowThumbnail({ entry }: { entry: ShowEntry }) {
  const key = `${entry.name} ${entry.etag}`;
  const [picture, setPicture] = useState(pictures.get(key) ?? null);
  const place = useRef<HTMLSpanElement>(null);
  useEffect(() => {
    const element = place.current;
    if (!element || pictures.has(key)) return;
    let wanted = true;
    const observer = new IntersectionObserver((seen) => {
      if (!seen.some((s) => s.isIntersecting)) return;
      observer.disconnect();
      pictureOf(entry.name).then(
        (found) => {
          if (!found || !wanted) return;
          if (pictures.size >= PICTURES_MAX) pictures.clear();
          pictures.set(key, found);
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
  }, [key, entry.name]);
  return (
    <span className={styles.picture} data-testid="entry-picture" ref={place}>
      {picture ? <Thumbnail frame={picture.frame} stage={picture.stage} /> : null}
    </span>
  );
}
