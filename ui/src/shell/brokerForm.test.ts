import { expect, test } from 'vitest';
import type { BrokerSettings } from '../api/types.gen';
import { connectOf, fieldsOf, usesTls } from './brokerForm';
import { brokerText } from './brokerWords';

const settings: BrokerSettings = {
  address: 'mqtts://stage:8883',
  user: 'me',
  has_password: true,
  ca: '/etc/ca.pem',
  client_cert: null,
  has_client_key: false,
  embedded: 'mqtt://127.0.0.1:1883',
};

test('the form begins with what is kept, and asks for what stands in it', () => {
  const fields = fieldsOf(settings);
  expect(fields).toMatchObject({ own: false, user: 'me', password: '', ca: '/etc/ca.pem' });
  expect(connectOf(fields)).toEqual({
    do: 'connect',
    address: 'mqtts://stage:8883',
    user: 'me',
    password: null,
    ca: '/etc/ca.pem',
    client_cert: null,
    client_key: null,
  });
  expect(usesTls(fields.address)).toBe(true);
});

test('the own broker needs no address, another one does', () => {
  const own = fieldsOf({ ...settings, address: 'embedded' });
  expect(connectOf(own)).toMatchObject({ address: 'embedded' });
  expect(connectOf({ ...own, own: false })).toBeNull();
  expect(fieldsOf({ ...settings, address: 'embedded', embedded: null }).own).toBe(false);
});

test('the state is said with its reason', () => {
  const broker = { address: 'mqtt://a', connected: false, node: null, reason: 'refused' };
  expect(brokerText({ ...broker, phase: 'retrying' })).toMatch(/trying again\. refused/);
  expect(brokerText({ ...broker, phase: 'off' })).toBe('Disconnected.');
  expect(brokerText({ ...broker, phase: 'connecting' })).toMatch(/Connecting to mqtt:\/\/a/);
  expect(brokerText({ ...broker, phase: 'connected', node: 'mqtt://b' })).toMatch(/mqtt:\/\/b/);
});
