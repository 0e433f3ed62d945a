/** Whether a drag with the first button or one finger moves the view, asked when the drag begins. */
export interface Pans {
  wanted(): boolean;
  /** A drag that moves the view has begun. */
  began(): void;
}

/** For stages on which nothing can be selected. */
export const ALWAYS: Pans = { wanted: () => true, began() {} };

/** For stages that only show. */
export const NEVER: Pans = { wanted: () => false, began() {} };
