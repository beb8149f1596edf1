// Reading places: the last heading read in each chapter, in this browser only.

export const PLACES_KEY = "epipole-places";

/** A chapter (the name of its file, without `.html`), and the anchor and text of a heading in it. */
export type Place = [chapter: string, anchor: string, title: string];

/** Maximum length of each part of a place, characters. */
const MAX_LENGTH = 300;

const isPart = (part: unknown) => typeof part === "string" && part !== "" && part.length <= MAX_LENGTH;
const isPlace = (place: unknown) => Array.isArray(place) && place.length === 3 && place.every(isPart);

/** Returns the places in a parsed JSON value, one per chapter, ignoring anything else. */
export function placesIn(value: unknown): Place[] {
  const places = Array.isArray(value) ? (value.filter(isPlace) as Place[]) : [];
  return places.filter(([chapter], index) => places.findIndex(([other]) => other === chapter) === index);
}

/** Returns the stored places, the last one read first; none if storage is blocked. */
export function storedPlaces(): Place[] {
  try {
    return placesIn(JSON.parse(localStorage.getItem(PLACES_KEY) ?? "[]"));
  } catch {
    return [];
  }
}

/** Stores places. Returns false if storage is blocked. */
export function storePlaces(places: Place[]): boolean {
  try {
    localStorage.setItem(PLACES_KEY, JSON.stringify(places));
    return true;
  } catch {
    return false;
  }
}

/** Forgets all places. Throws if storage is blocked. */
export function forgetPlaces(): void {
  localStorage.removeItem(PLACES_KEY);
}

/** Returns the chapter of an address, by the name of its file. */
export function chapterOf({ pathname }: { pathname: string }): string {
  return (pathname.split("/").pop() ?? "").replace(/\.html$/, "");
}
