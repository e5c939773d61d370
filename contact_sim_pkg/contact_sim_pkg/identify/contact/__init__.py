"""Contacts and impulses: impacts, lasting contacts, friction."""
