import type { BrokerSettings, Operation } from '../api/types.gen';

/** Fields of the broker form. Password and key are empty until typed: kept ones stay on the server. */
export interface BrokerFields {
  /** Whether the built-in broker is chosen. */
  own: boolean;
  address: string;
  user: string;
  password: string;
  ca: string;
  clientCert: string;
  clientKey: string;
}

export function fieldsOf(settings: BrokerSettings): BrokerFields {
  const own = settings.address === 'embedded' || settings.address === '';
  return {
    own: own && settings.embedded !== null,
    address: own ? '' : settings.address,
    user: settings.user ?? '',
    password: '',
    ca: settings.ca ?? '',
    clientCert: settings.client_cert ?? '',
    clientKey: '',
  };
}

/** The operation that the form requests; null: another broker is chosen, without an address. */
export function connectOf(fields: BrokerFields): (Operation & { do: 'connect' }) | null {
  if (fields.own) return { do: 'connect', address: 'embedded', user: null, password: null };
  const address = fields.address.trim();
  if (address === '') return null;
  const given = (text: string) => text.trim() || null;
  return {
    do: 'connect',
    address,
    user: given(fields.user),
    password: fields.password || null,
    ca: given(fields.ca),
    client_cert: given(fields.clientCert),
    client_key: given(fields.clientKey),
  };
}

export const usesTls = (address: string) => address.includes('mqtts://');
