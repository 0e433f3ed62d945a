import { Button, PasswordInput, TextInput } from '@mantine/core';
import { useState } from 'react';
import { addPerson } from '../api/http';
import type { NewPerson } from '../api/types.gen';
import type { Act } from './PersonRow';
import { RoleSelect } from './RoleSelect';
import styles from './People.module.css';

const EMPTY: NewPerson = { name: '', role: 'viewer', password: '' };

/** A form that adds a person with name, password and role. */
export function NewPersonForm({ act }: { act: Act }) {
  const [person, setPerson] = useState(EMPTY);
  const { name, role, password } = person;
  return (
    <form
      className={styles.form}
      aria-label="Add a person"
      onSubmit={(event) => {
        event.preventDefault();
        void act(() => addPerson(person)).then((done) => done && setPerson(EMPTY));
      }}
    >
      <TextInput
        label="Name"
        autoComplete="off"
        value={name}
        onChange={(event) => setPerson({ ...person, name: event.currentTarget.value })}
      />
      <PasswordInput
        label="Password"
        autoComplete="new-password"
        w="12rem"
        value={password}
        onChange={(event) => setPerson({ ...person, password: event.currentTarget.value })}
      />
      <RoleSelect
        label="Role"
        isShown
        role={role}
        onRole={(to) => setPerson({ ...person, role: to })}
      />
      <Button type="submit" disabled={name === '' || password === ''}>
        Add
      </Button>
    </form>
  );
}
