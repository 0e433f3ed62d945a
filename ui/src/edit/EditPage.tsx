/** Drawing. */
export function EditPage() {
  return <main className="page" />;
}
