import type {
  AccountEntry,
  BrokerSettings,
  FormatName,
  MadeToken,
  NewPerson,
  PersonChange,
  Plan,
  PlaylistChange,
  PlaylistState,
  RunEntry,
  ShowEntry,
  ShowState,
} from './types.gen';

/** A request that failed, with the server's message. `status`: of HTTP; 0: the server could not be reached. */
export class Refused extends Error {
  constructor(
    readonly status: number,
    message: string,
  ) {
    super(message);
  }
}

async function request(path: string, init?: RequestInit): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(path, init);
  } catch {
    throw new Refused(0, 'The server cannot be reached. Is lightbots still running?');
  }
  if (response.ok) return response;
  const text = await response.text();
  let error = text.slice(0, 300) || `The server answered ${response.status}.`;
  try {
    error = (JSON.parse(text) as { error?: string }).error ?? error;
  } catch {
    // Not a problem in JSON: the text itself is the message.
  }
  throw new Refused(response.status, error);
}

const showPath = (name: string) => `/api/shows/${encodeURIComponent(name)}`;

export const listShows = async () => (await (await request('/api/shows')).json()) as ShowEntry[];

/** The document of a show in the library, and its version; null: the answer names none. */
export async function getShow(name: string): Promise<{ document: unknown; etag: string | null }> {
  const response = await request(showPath(name));
  return { document: await response.json(), etag: response.headers.get('etag') };
}

/** The file of a show as the library keeps it, with everything that the screen does not know. */
export const getFile = async (name: string) => (await request(`${showPath(name)}/file`)).blob();

/** Saves a file of any format. `etag`: the version it replaces; `'new'`: only if the name is free; null: whatever. */
export async function putShow(
  name: string,
  body: BodyInit,
  etag: string | 'new' | null,
): Promise<ShowEntry> {
  const headers: Record<string, string> = { 'Content-Type': 'application/json' };
  if (etag === 'new') headers['If-None-Match'] = '*';
  else if (etag !== null) headers['If-Match'] = etag;
  const response = await request(showPath(name), { method: 'PUT', headers, body });
  return (await response.json()) as ShowEntry;
}

/**
 * Deletes a show of the library, if it still has the version `etag`; null: whatever its version. `renamedTo`: name of
 * a show that gets the earlier states.
 */
export const deleteShow = (name: string, etag: string | null, renamedTo: string | null = null) =>
  request(
    showPath(name) + (renamedTo === null ? '' : `?renamed_to=${encodeURIComponent(renamedTo)}`),
    { method: 'DELETE', headers: etag === null ? {} : { 'If-Match': etag } },
  );

/** The saved states of a show, the newest first; the first is the show as it is. */
export const listStates = async (name: string) =>
  (await (await request(`${showPath(name)}/states`)).json()) as ShowState[];

/** The document of the saved state with that number; `null`: of the show as it is. */
export async function getState(name: string, number: number | null): Promise<unknown> {
  const path = number === null ? '' : `/states/${number}`;
  return (await request(`${showPath(name)}${path}`)).json();
}

/** The recorded runs, the newest first. */
export const listRuns = async () => (await (await request('/api/runs')).json()) as RunEntry[];

/** The address of a run's report. */
export const reportAddress = (number: number) => `/api/runs/${number}/report`;

/** The kept settings of the broker, without secrets. */
export const getBroker = async () =>
  (await (await request('/api/broker')).json()) as BrokerSettings;

/** The plan of the open show, with paths. */
export const getPlan = async () => (await (await request('/api/plan')).json()) as Plan;

/** A show as a file of a format. `body` is a file of any format. */
export const convertShow = async (body: BodyInit, to: FormatName) =>
  (await request(`/api/convert?to=${to}`, { method: 'POST', body })).blob();

const assetPath = (hash: string) => `/api/assets/${hash}`;

/** The bytes of a file by its SHA-256, which shows name. */
export const getAsset = async (hash: string) =>
  new Uint8Array(await (await request(assetPath(hash))).arrayBuffer());

/** Sends a file to the server under its SHA-256, so that shows can name it. */
export const putAsset = (hash: string, bytes: Uint8Array<ArrayBuffer>) =>
  request(assetPath(hash), { method: 'PUT', body: bytes });

const json = (method: string, body: unknown): RequestInit => ({
  method,
  headers: { 'Content-Type': 'application/json' },
  body: JSON.stringify(body),
});

const accountPath = (kind: 'people' | 'tokens', name: string) =>
  `/api/${kind}/${encodeURIComponent(name)}`;

/** The people with accounts, or the tokens of programs. */
export const listAccounts = async (kind: 'people' | 'tokens') =>
  (await (await request(`/api/${kind}`)).json()) as AccountEntry[];

export const addPerson = (person: NewPerson) => request('/api/people', json('POST', person));

export const changePerson = (name: string, change: PersonChange) =>
  request(accountPath('people', name), json('PUT', change));

/** Removes a person or a token: nothing of theirs is admitted from then on. */
export const removeAccount = (kind: 'people' | 'tokens', name: string) =>
  request(accountPath(kind, name), { method: 'DELETE' });

/** Makes a token for a program and answers it; the server does not show it again. */
export const makeToken = async (token: AccountEntry) =>
  ((await (await request('/api/tokens', json('POST', token))).json()) as MadeToken).token;

/** The playlist as it is. */
export const getPlaylist = async () =>
  (await (await request('/api/playlist')).json()) as PlaylistState;

/** Changes the playlist; answers the playlist afterwards. */
export const putPlaylist = async (change: PlaylistChange) =>
  (await (await request('/api/playlist', json('PUT', change))).json()) as PlaylistState;
